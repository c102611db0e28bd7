#pragma once

#include <vector>

#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// The lumped preconditioner of FETI, B̂WKWB̂ᵀ (P2; W as in through_touched): of each K only the part on the unknowns that
/// rows touch counts. The condition on im P grows as H/h, as that of F: 4.2, 6.3, 8.5
/// for cubes with H/h = 4, 6, 8.
class Lumped {
 public:
  /// `dual` must outlive the object.
  explicit Lumped(const DualProblem& dual);
  algebra::Vector apply(const algebra::Vector& lambda) const;

 private:
  const DualProblem& dual_;
  std::vector<Batch> batches_;                    ///< of equal pieces that rows touch alike
  std::vector<algebra::SparseMatrix> stiffness_;  ///< of each kind of them: K_bb, lower triangle
};

}  // namespace dotyk::solver
