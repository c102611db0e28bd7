#pragma once

#include <vector>

#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// The preconditioners of FETI by the stiffness of pieces on the unknowns b that rows touch, i being the others (W as in
/// through_touched). Equal pieces that rows touch alike share it.
///
/// Lumped, B̂WKWB̂ᵀ (P2): of each K only K_bb counts. The condition on im P grows as H/h, as that of F: 4.2, 6.3, 8.5
/// for cubes with H/h = 4, 6, 8.
///
/// Dirichlet, B̂W [0 0; 0 S] WB̂ᵀ (Farhat, Mandel and Roux 1994): with
///   S = K_bb − K_bi K_ii⁺ K_ib,
/// the stiffness of the piece felt on b. On im P the eigenvalues of what it makes of F go from 1 to C(1 + log H/h)²: 2.9,
/// 4.0, 4.9 for cubes with H/h = 4, 6, 8, where F itself has κ = 19, 28, 38.
class PieceStiffness {
 public:
  /// Lumped. `dual` must outlive the object.
  explicit PieceStiffness(const DualProblem& dual);
  /// Dirichlet: orders and factors the insides. Throws as DualProblem does.
  PieceStiffness(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor);

  algebra::Vector apply(const algebra::Vector& lambda) const;
  double factor_bytes() const;
  int factors() const { return static_cast<int>(insides_.size()); }  ///< distinct ones

 private:
  struct Inside {
    std::vector<int> unknowns;            ///< i
    algebra::SparseMatrix coupling;       ///< K_ib
    algebra::GeneralisedInverse inverse;  ///< K_ii⁺
  };

  const DualProblem& dual_;
  std::vector<std::vector<int>> alike_;           ///< equal pieces that rows touch alike
  std::vector<Batch> batches_;                    ///< of them
  std::vector<algebra::SparseMatrix> stiffness_;  ///< of each kind of them: K_bb, lower triangle
  std::vector<Inside> insides_;                   ///< likewise; empty where lumped
};

}  // namespace dotyk::solver
