#pragma once

#include <vector>

#include "solver/dual_problem.hpp"

namespace dotyk::solver {

/// The Dirichlet preconditioner of FETI, B̂ [0 0; 0 S] B̂ᵀ (Farhat, Mandel and Roux 1994): with b the unknowns of a piece
/// that rows touch and i the others,
///   S = K_bb − K_bi K_ii⁺ K_ib,
/// the stiffness of the piece felt on b. The rows of B̂ being orthonormal no weights are needed. Equal pieces that rows
/// touch alike share the factor of K_ii.
class Dirichlet {
 public:
  /// Orders and factors the insides. `dual` must outlive the object. Throws as DualProblem does.
  Dirichlet(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor);

  algebra::Vector apply(const algebra::Vector& lambda) const;
  double factor_bytes() const;
  int factors() const { return static_cast<int>(insides_.size()); }  ///< distinct ones

 private:
  struct Inside {
    std::vector<int> unknowns;  ///< own ones that no row touches, ascending
    const algebra::SparseMatrix* K;
    algebra::GeneralisedInverse inverse;
  };
  Inside inside(int kind, const Piece& piece, algebra::Ordering ordering) const;

  const DualProblem& dual_;
  std::vector<std::vector<int>> alike_;  ///< equal pieces that rows touch alike
  std::vector<Batch> batches_;           ///< of them
  std::vector<Inside> insides_;          ///< one for each
};

}  // namespace dotyk::solver
