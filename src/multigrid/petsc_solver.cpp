#include "multigrid/petsc_solver.hpp"

#include <cmath>
#include <cstdio>

namespace dotyk::multigrid {

namespace {

constexpr int kMostIterations = 1000;

/// One sweep of Gauss and Seidel, `type` its direction: forward before the coarse correction and backward after it make the cycle
/// symmetric.
void make_smoother(KSP ksp, Mat matrix, MatSORType type) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPRICHARDSON));
  check(KSPSetNormType(ksp, KSP_NORM_NONE));
  check(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 1));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCSOR));
  check(PCSORSetSymmetric(pc, type));
}

void make_coarsest(KSP ksp, Mat matrix) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetShiftType(pc, MAT_SHIFT_POSITIVE_DEFINITE));
}

struct Ending {
  double residual = 0;  // at which to end
  const Watcher& watcher;
  bool stopped = false;
};

PetscErrorCode ended(KSP, PetscInt iteration, PetscReal residual, KSPConvergedReason* reason, void* context) {
  Ending& ending = *static_cast<Ending*>(context);
  *reason = KSP_CONVERGED_ITERATING;
  if (!std::isfinite(residual))
    *reason = KSP_DIVERGED_NANORINF;
  else if (residual <= ending.residual)
    *reason = KSP_CONVERGED_RTOL;
  else if (iteration >= kMostIterations)
    *reason = KSP_DIVERGED_ITS;
  else if (ending.watcher.stop(ending.watcher.who))
    ending.stopped = true, *reason = KSP_DIVERGED_BREAKDOWN;
  return 0;
}

}  // namespace

PetscSolver::PetscSolver(const Matrix& matrix) : hierarchy_(matrix) {
  check(MatCreateVecs(hierarchy_.matrix(0), x_.put(), b_.put()));
  make_cycle();
}

void PetscSolver::make_cycle() {
  check(KSPCreate(PETSC_COMM_SELF, ksp_.put()));
  check(KSPSetOperators(ksp_, hierarchy_.matrix(0), hierarchy_.matrix(0)));
  check(KSPSetType(ksp_, KSPCG));
  check(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCMG));
  const int levels = hierarchy_.levels();
  check(PCMGSetLevels(pc, levels, nullptr));
  check(PCMGSetGalerkin(pc, PC_MG_GALERKIN_EXTERNAL));
  for (int l = 0; l < levels; ++l) {  // PETSc counts from the coarsest
    KSP ksp = nullptr;
    const int theirs = levels - 1 - l;
    if (theirs == 0) {
      check(PCMGGetCoarseSolve(pc, &ksp));
      make_coarsest(ksp, hierarchy_.matrix(l));
      continue;
    }
    check(PCMGSetInterpolation(pc, theirs, hierarchy_.interpolation(l)));
    check(PCMGGetSmootherDown(pc, theirs, &ksp));
    make_smoother(ksp, hierarchy_.matrix(l), SOR_LOCAL_FORWARD_SWEEP);
    if (l == 0) finest_.attach(ksp, true);
    check(PCMGGetSmootherUp(pc, theirs, &ksp));
    make_smoother(ksp, hierarchy_.matrix(l), SOR_LOCAL_BACKWARD_SWEEP);
    if (l == 0) finest_.attach(ksp, false);
    check(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE));
  }
}

bool PetscSolver::set(const algebra::SparseMatrix& lower, const std::vector<char>& held) {
  if (!hierarchy_.set(lower, held)) return false;
  finest_.set(hierarchy_.matrix(0), hierarchy_.shared());
  check(KSPSetOperators(ksp_, hierarchy_.matrix(0), hierarchy_.matrix(0)));
  check(KSPSetUp(ksp_));
  return true;
}

Outcome PetscSolver::solve(const double* b, double tolerance, double* x, const Watcher& watcher) {
  const std::vector<int>& slot = hierarchy_.embedding().slot();
  check(VecSet(b_, 0.0));
  PetscScalar* in = nullptr;
  check(VecGetArray(b_, &in));
  for (std::size_t i = 0; i < slot.size(); ++i) in[slot[i]] = b[i];
  check(VecRestoreArray(b_, &in));
  PetscReal norm = 0;
  check(VecNorm(b_, NORM_2, &norm));
  Ending ending{tolerance * norm, watcher};
  check(KSPSetConvergenceTest(ksp_, ended, &ending, nullptr));
  check(KSPSolve(ksp_, b_, x_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(ksp_, &reason));
  check(KSPGetIterationNumber(ksp_, &iterations));
  iterations_ += iterations;
  if (ending.stopped) return Outcome::stopped;
  if (reason <= 0) return Outcome::not_definite;
  const PetscScalar* out = nullptr;
  check(VecGetArrayRead(x_, &out));
  for (std::size_t i = 0; i < slot.size(); ++i) x[i] = out[slot[i]];
  check(VecRestoreArrayRead(x_, &out));
  return Outcome::done;
}

Facts PetscSolver::facts() const {
  Facts f;
  f.bytes = hierarchy_.bytes();
  f.iterations = iterations_;
  f.levels = hierarchy_.levels();
  std::snprintf(f.version, sizeof f.version, "%d.%d", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR);
  return f;
}

}  // namespace dotyk::multigrid
