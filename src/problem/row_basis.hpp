#pragma once

#include <utility>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// A basis of the displacements in which rows are unknowns: u = T u', and (B u)_r = u'_p for a row r with an unknown p of its own. To hold a row
/// is then to hold an unknown, and a spring in it is a number on the diagonal (the transformation of Wohlmuth and Krause, SIAM J. Sci. Comput. 25
/// (2003), with a pivot for every row instead of a side for every contact). All other unknowns stay as they are.
struct RowBasis {
  algebra::SparseMatrix T;   ///< unknowns × unknowns; empty where it is diagonal, each number 1 or −1
  algebra::Vector signs;     ///< the diagonal then; empty where T is the identity
  std::vector<int> unknown;  ///< of every row; -1 where others leave it none: rows that nearly depend on each other, or reach too far
  bool of_signs() const { return T.rows() == 0; }
  bool trivial() const { return of_signs() && signs.size() == 0; }
  /// The displacements T u', and the forces Tᵀ f in this basis.
  algebra::Vector displacements(algebra::Vector u) const { return of_signs() ? with_signs(std::move(u)) : T * u; }
  algebra::Vector forces(algebra::Vector f) const { return of_signs() ? with_signs(std::move(f)) : T.transpose() * f; }
  /// For a T of signs: TᵀKT of a lower triangle K, or K of TᵀKT.
  algebra::StoredMatrix with_signs(algebra::StoredMatrix lower) const;
  /// R T: the rows R, which act on displacements, as rows that act on the unknowns u'.
  algebra::SparseRows times(const algebra::SparseRows& R) const;
  /// S = T⁻¹: u' = S u.
  algebra::SparseMatrix of_displacements(const Problem& problem) const;

 private:
  algebra::Vector with_signs(algebra::Vector x) const {
    if (signs.size() > 0) x.array() *= signs.array();
    return x;
  }
};

/// Gives each row an unknown of its own. The candidates are those with a factor of at least a fifth of the row's greatest. Among them it takes the one
/// that is in fewest rows, and among several the one with the greatest factor: a small divisor would make other unknowns stiff.
/// A row gets none if elimination leaves less than a hundredth of its greatest factor, or if some unknown would depend on more than 1000 others (or
/// three times as many as the row has, where that is more).
RowBasis row_basis(const Problem& problem);

}  // namespace dotyk::problem
