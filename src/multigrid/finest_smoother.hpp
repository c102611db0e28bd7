// What smooths on the finest level.
#pragma once

#include <vector>

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// One sweep of Gauss and Seidel, and an exact solution at unknowns that share stiffness by a row, by CHOLMOD: there stiff and soft modes have the same
/// unknowns, and sweeps alone would be as many times slower as the root of the contrast (on elements of order 2, whose rows are means, seven times).
/// Before the coarse correction the sweep goes forward and comes first, after it backward and last, so that the cycle is symmetric.
class FinestSmoother {
 public:
  /// Takes the numbers of `matrix`, which must outlive this; `shared`: rows, ascending, may be none. False where they are not definite.
  bool set(Mat matrix, const std::vector<PetscInt>& shared);
  /// Makes it the smoother of a level of PCMG, which it must outlive in its place.
  void attach(KSP level, bool before);

 private:
  static PetscErrorCode smooth(PC shell, Vec b, Vec x, Vec, PetscReal, PetscReal, PetscReal, PetscInt, PetscBool from_zero, PetscInt* count,
                               PCRichardsonConvergedReason* reason);
  void solve_shared(Vec b, Vec x);

  struct Side {
    FinestSmoother* smoother;
    bool before;
  };
  Side sides_[2] = {{this, false}, {this, true}};
  Mat matrix_ = nullptr;
  std::vector<PetscInt> shared_;
  OwnedMat rows_, block_;  ///< of the matrix, at the shared unknowns
  OwnedKsp exact_;
  OwnedVec left_, change_;
};

}  // namespace dotyk::multigrid
