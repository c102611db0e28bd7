#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// The lower triangle of A + B, columns sorted, as theirs must be. Room is taken at once: Eigen's own sum, which grows, takes five times as long where
/// matrices are large.
SparseMatrix lower_sum(const SparseMatrix& A, const SparseMatrix& B);

/// PᵀAP, m × m, of a symmetric A, n × n, for P, n × m. `lower` has no entries above the diagonal; nor has the result, whose columns are sorted.
SparseMatrix congruent(const SparseMatrix& lower, const SparseMatrix& P);

}  // namespace dotyk::algebra
