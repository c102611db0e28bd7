#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// A basis of the displacements in which rows are unknowns: u = T u', and (B u)_r = u'_p for a row r with an unknown p of its own. To hold a row
/// is then to hold an unknown, and a spring in it is a number on the diagonal (the transformation of Wohlmuth and Krause, SIAM J. Sci. Comput. 25
/// (2003), with a pivot for every row instead of a side for every contact). All other unknowns stay as they are.
struct RowBasis {
  algebra::SparseMatrix T;   ///< unknowns × unknowns
  std::vector<int> unknown;  ///< of every row; -1 where others leave it none: rows that depend on each other, or reach too far
  /// Displacements in this basis, T⁻¹ of every column.
  algebra::SparseMatrix coordinates(const Problem& problem, const algebra::SparseMatrix& displacements) const;
};

/// Gives each row the unknown that fewest rows share, of those whose factor is at least a fifth of its greatest. None to a row
/// whose elimination would make it, or another, reach three times as far.
RowBasis row_basis(const Problem& problem);

}  // namespace dotyk::problem
