#include "multigrid/shared_rows.hpp"

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

bool SharedRows::set(Mat matrix, const std::vector<int>& shared) {
  shared_ = shared;
  const Ranks ranks = ranks_of(matrix);
  any_ = !ranks.all(shared_.empty());
  if (!any_) return true;
  PetscInt first = 0, size = 0;
  check(MatGetOwnershipRange(matrix, &first, nullptr));
  check(MatGetLocalSize(matrix, &size, nullptr));
  Owned<IS, ISDestroy> some, all;
  std::vector<PetscInt> numbers(shared_);
  for (PetscInt& row : numbers) row += first;
  check(ISCreateGeneral(ranks.comm(), static_cast<PetscInt>(numbers.size()), numbers.data(), PETSC_COPY_VALUES, some.put()));
  check(ISCreateStride(ranks.comm(), size, first, 1, all.put()));
  rows_ = OwnedMat(), block_ = OwnedMat(), exact_ = OwnedKsp(), left_ = OwnedVec(), change_ = OwnedVec();
  check(MatCreateSubMatrix(matrix, some, all, MAT_INITIAL_MATRIX, rows_.put()));
  check(MatCreateSubMatrix(matrix, some, some, MAT_INITIAL_MATRIX, block_.put()));
  check(MatCreateVecs(block_, change_.put(), left_.put()));
  check(KSPCreate(ranks.comm(), exact_.put()));
  factor_on_each(exact_, block_, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  return set_up(exact_);
}

void SharedRows::solve(Vec b, Vec x) {
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
