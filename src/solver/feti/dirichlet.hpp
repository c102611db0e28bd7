#pragma once

#include <functional>
#include <vector>

#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// The Dirichlet preconditioner of FETI, B̂W [0 0; 0 S] WB̂ᵀ (Farhat, Mandel and Roux 1994; W as in through_touched): with b
/// the unknowns of a piece that rows touch and i the others,
///   S = K_bb − K_bi K_ii⁺ K_ib,
/// the stiffness of the piece felt on b. B̂ᵀB̂W takes the mean of its copies, weighted by their stiffness, from each unknown, which
/// is what the ρ-scaling is for (Klawonn and Widlund 2001). On im P the
/// eigenvalues of what it makes of F go from 1 to C(1 + log H/h)²: 2.9, 4.0, 4.9 for cubes with H/h = 4, 6, 8, where F
/// itself has κ = 19, 28, 38. Equal pieces that rows touch alike share the factor of K_ii.
class Dirichlet {
 public:
  /// Orders and factors the insides. `dual` must outlive the object. Throws as DualProblem does.
  Dirichlet(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor);

  algebra::Vector apply(const algebra::Vector& lambda) const;
  double factor_bytes() const;
  int factors() const { return static_cast<int>(parts_.size()); }  ///< distinct ones

 private:
  struct Part {
    algebra::SparseMatrix stiffness;     ///< K_bb, lower triangle
    algebra::SparseMatrix coupling;      ///< K_ib
    algebra::GeneralisedInverse inside;  ///< K_ii⁺
  };
  void add(const Piece& piece, const algebra::DenseMatrix& basis, algebra::Ordering ordering);
  void factor(Monitor& monitor, const std::function<const Piece&(int)>& piece_of);

  const DualProblem& dual_;
  std::vector<Batch> batches_;  ///< of equal pieces that rows touch alike
  std::vector<Part> parts_;     ///< one for each kind of them
};

}  // namespace dotyk::solver
