#pragma once

#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::solver {

/// K + Σ_r s_r B_rᵀB_r with the rows and columns of held unknowns emptied but for their diagonal: what active-set and barrier
/// iterations solve with where rows act on few unknowns each. One ordering and analysis for all s and all that is held.
/// Motions that no row notices are held as well, at as many unknowns, and taken off solutions.
class HeldStiffness {
 public:
  HeldStiffness(const problem::Problem& problem, const problem::RigidMotions& rigid, algebra::Ordering ordering);

  /// `spring`: s, force per displacement, rows; `held`: one flag an unknown. False where the matrix is not positive definite.
  bool factor(const algebra::Vector& spring, const std::vector<char>& held);
  /// Zero in held unknowns, which b must be, too.
  algebra::Vector solve(const algebra::Vector& b) const;

  const algebra::Cholesky& cholesky() const { return *cholesky_; }

 private:
  void assemble();
  void place_rows();

  const problem::Problem& problem_;
  const algebra::SparseMatrix unnoticed_;
  algebra::SparseMatrix lower_;     ///< of the analysed pattern, with the numbers of the last factor()
  algebra::Vector stiffness_;       ///< K's numbers in that pattern
  std::vector<std::ptrdiff_t> first_;  ///< of a row's products in the next
  std::vector<int> place_;          ///< in the pattern, of each product B_ri B_rj
  std::vector<double> product_;
  std::optional<algebra::Cholesky> cholesky_;
};

}  // namespace dotyk::solver
