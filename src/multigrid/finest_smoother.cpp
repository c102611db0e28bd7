#include "multigrid/damping.hpp"
#include "multigrid/finest_smoother.hpp"

namespace dotyk::multigrid {

void factor_on_each(KSP ksp, Mat matrix, MatFactorShiftType shift, MatSolverType library) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  if (!ranks_of(matrix).alone()) {
    check(PCSetType(pc, PCREDUNDANT));
    check(PCRedundantSetNumber(pc, ranks_of(matrix).count()));
    KSP own = nullptr;
    check(PCRedundantGetKSP(pc, &own));
    check(KSPSetType(own, KSPPREONLY));
    check(KSPGetPC(own, &pc));
  }
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetShiftType(pc, shift));
  check(PCFactorSetMatSolverType(pc, library));
}

bool set_up(KSP ksp) {
  const PetscErrorCode code = KSPSetUp(ksp);
  if (code == PETSC_ERR_MAT_CH_ZRPVT) return false;
  check(code);
  return true;
}

bool FinestSmoother::set(Mat matrix, const std::vector<int>& shared) {
  matrix_ = matrix, shared_ = shared, omega_ = damping(matrix, shared);
  const Ranks ranks = ranks_of(matrix);
  any_ = !ranks.all(shared_.empty());
  if (!any_) return true;
  PetscInt first = 0, size = 0;
  check(MatGetOwnershipRange(matrix_, &first, nullptr));
  check(MatGetLocalSize(matrix_, &size, nullptr));
  Owned<IS, ISDestroy> some, all;
  std::vector<PetscInt> numbers(shared_);
  for (PetscInt& row : numbers) row += first;
  check(ISCreateGeneral(ranks.comm(), static_cast<PetscInt>(numbers.size()), numbers.data(), PETSC_COPY_VALUES, some.put()));
  check(ISCreateStride(ranks.comm(), size, first, 1, all.put()));
  rows_ = OwnedMat(), block_ = OwnedMat(), exact_ = OwnedKsp(), left_ = OwnedVec(), change_ = OwnedVec();
  check(MatCreateSubMatrix(matrix_, some, all, MAT_INITIAL_MATRIX, rows_.put()));
  check(MatCreateSubMatrix(matrix_, some, some, MAT_INITIAL_MATRIX, block_.put()));
  check(MatCreateVecs(block_, change_.put(), left_.put()));
  check(KSPCreate(ranks.comm(), exact_.put()));
  factor_on_each(exact_, block_, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  return set_up(exact_);
}

void FinestSmoother::attach(KSP level, bool before) {
  PC pc = nullptr;
  check(KSPGetPC(level, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &sides_[before]));
  check(PCShellSetApplyRichardson(pc, smooth));
}

PetscErrorCode FinestSmoother::smooth(PC shell, Vec b, Vec x, Vec, PetscReal, PetscReal, PetscReal, PetscInt, PetscBool from_zero, PetscInt* count,
                                      PCRichardsonConvergedReason* reason) {
  void* context = nullptr;
  PetscCall(PCShellGetContext(shell, &context));
  const auto [self, before] = *static_cast<Side*>(context);
  *count = 1, *reason = PCRICHARDSON_CONVERGED_ITS;
  try {
    if (before) check(MatSOR(self->matrix_, b, self->omega_, static_cast<MatSORType>(SOR_LOCAL_FORWARD_SWEEP | (from_zero ? SOR_ZERO_INITIAL_GUESS : 0)), 0, 1, 1, x));
    else if (from_zero) check(VecSet(x, 0));
    self->solve_shared(b, x);
    if (!before) check(MatSOR(self->matrix_, b, self->omega_, SOR_LOCAL_BACKWARD_SWEEP, 0, 1, 1, x));
  } catch (const std::exception& error) {
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  return 0;
}

void FinestSmoother::solve_shared(Vec b, Vec x) {
  if (!any_) return;
  check(MatMult(rows_, x, left_));
  const PetscScalar *all = nullptr, *change = nullptr;
  PetscScalar *left = nullptr, *out = nullptr;
  check(VecGetArrayRead(b, &all));
  check(VecGetArray(left_, &left));
  for (std::size_t i = 0; i < shared_.size(); ++i) left[i] = all[shared_[i]] - left[i];
  check(VecRestoreArray(left_, &left));
  check(VecRestoreArrayRead(b, &all));
  check(KSPSolve(exact_, left_, change_));
  check(VecGetArrayRead(change_, &change));
  check(VecGetArray(x, &out));
  for (std::size_t i = 0; i < shared_.size(); ++i) out[shared_[i]] += change[i];
  check(VecRestoreArray(x, &out));
  check(VecRestoreArrayRead(change_, &change));
}

}  // namespace dotyk::multigrid
