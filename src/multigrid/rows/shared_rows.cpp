#include "multigrid/rows/shared_rows.hpp"

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

bool SharedRows::set(const HalfMatrix& matrix, const std::vector<int>& shared) {
  shared_ = shared;
  const Ranks& ranks = matrix.ranks();
  any_ = !ranks.all(shared_.empty());
  if (!any_) return true;
  const PetscInt count = static_cast<PetscInt>(shared_.size());
  Owned<IS, ISDestroy> some, all;
  std::vector<PetscInt> columns(shared_);
  for (PetscInt& column : columns) column += matrix.first_row();
  check(ISCreateGeneral(ranks.comm(), count, columns.data(), PETSC_COPY_VALUES, some.put()));
  check(ISCreateStride(ranks.comm(), count, ranks.before(count), 1, all.put()));
  rows_ = copied(ranks, matrix.full(shared_), matrix.rows());
  block_ = OwnedMat(), exact_ = OwnedKsp(), left_ = OwnedVec(), change_ = OwnedVec();
  check(MatCreateSubMatrix(rows_, all, some, MAT_INITIAL_MATRIX, block_.put()));
  check(MatCreateVecs(block_, change_.put(), left_.put()));
  check(KSPCreate(ranks.comm(), exact_.put()));
  factor_on_each(exact_, block_, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  return set_up(exact_);
}

void SharedRows::solve(Vec b, Vec x) {
  if (!any_) return;
  check(MatMult(rows_, x, left_));
  {
    const ReadNumbers of(b);
    Numbers left(left_);
    for (std::size_t i = 0; i < shared_.size(); ++i) left[i] = of[shared_[i]] - left[i];
  }
  check(KSPSolve(exact_, left_, change_));
  const ReadNumbers change(change_);
  Numbers out(x);
  for (std::size_t i = 0; i < shared_.size(); ++i) out[shared_[i]] += change[i];
}

}  // namespace dotyk::multigrid
