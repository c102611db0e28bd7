// What smooths on the finest level.
#pragma once

#include <vector>

#include "multigrid/local_rows.hpp"

namespace dotyk::multigrid {

/// One sweep of Gauss and Seidel, each rank's own, and an exact solution at unknowns that share stiffness by a row, by CHOLMOD: there stiff and soft modes have
/// the same unknowns, and sweeps alone would be as many times slower as the root of the contrast (on elements of order 2, whose rows are means,
/// seven times). Before the coarse correction the sweep goes forward and comes first, after it backward and last, so that the cycle is symmetric.
class FinestSmoother {
 public:
  /// Takes the numbers of `matrix`, which must outlive this; `shared`: rows of this rank, ascending, may be none. Collective. False where they are
  /// not definite.
  bool set(Mat matrix, const std::vector<int>& shared);
  /// Makes it the smoother of a level of PCMG; it must outlive that, and must not be moved.
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
  double omega_ = 1;
  bool any_ = false;         ///< shared rows, on any rank
  std::vector<int> shared_;  ///< counted from the rank's first row
  OwnedMat rows_, block_;    ///< of the matrix, at the shared unknowns
  OwnedKsp exact_;
  OwnedVec left_, change_;
};

/// Makes `ksp` solve with a sparse matrix that is small enough for a factor, on every rank the same one. Collective.
void factor_on_each(KSP ksp, Mat matrix, MatFactorShiftType shift, MatSolverType library);

/// Makes the factors that `ksp` needs. False where a matrix is not positive definite. Collective; may be false on some ranks only.
bool set_up(KSP ksp);

}  // namespace dotyk::multigrid
