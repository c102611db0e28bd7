#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// The lower triangle of A + B. Columns of all three are sorted by rows. Room for the sum is taken at once: Eigen's own sum takes it piece by piece, and
/// then most of the time goes into copies where matrices are large.
SparseMatrix lower_sum(const SparseMatrix& A, const SparseMatrix& B);

/// The matrix with these square blocks on its diagonal, in their order. They are compressed.
SparseMatrix block_diagonal(const std::vector<const SparseMatrix*>& blocks);

/// The same rows, compressed, with other numbers of columns. `place`: of each column with entries its new number, ascending; −1 of others.
void with_columns(const SparseRows& rows, const std::vector<int>& place, SparseRows& out);

/// Some columns of a matrix, ascending. `place`: of each row its number among those of the part, ascending; −1: it is left out.
SparseMatrix part_of(const SparseMatrix& from, const std::vector<int>& place, const std::vector<int>& columns);

/// PᵀAP, m × m, of a symmetric A, n × n, for P, n × m. `lower` has no entries above the diagonal; nor has the result, whose columns are sorted.
SparseMatrix congruent(const SparseMatrix& lower, const SparseMatrix& P);
SparseMatrix congruent(const SparseMatrix& lower, const SparseRows& P);
/// The same where `lower` has entries in few rows and columns: it looks at all columns of P, but computes with these rows alone.
StoredMatrix congruent_near(const SparseMatrix& lower, const SparseMatrix& P);

}  // namespace dotyk::algebra
