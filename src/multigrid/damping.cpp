#include "multigrid/damping.hpp"

#include <algorithm>

#include "multigrid/local_rows.hpp"

namespace dotyk::multigrid {

namespace {

/// A_between, for products with it.
class Between {
 public:
  explicit Between(Mat A, Vec like) {
    Owned<IS, ISDestroy> columns;
    PetscInt count = 0;
    const PetscInt* others = nullptr;
    check(MatMPIAIJGetSeqAIJ(A, nullptr, &rows_, &others));
    check(MatGetSize(rows_, nullptr, &count));
    check(ISCreateGeneral(PETSC_COMM_SELF, count, others, PETSC_COPY_VALUES, columns.put()));
    check(VecCreateSeq(PETSC_COMM_SELF, count, theirs_.put()));
    check(VecScatterCreate(like, columns, theirs_, nullptr, fetch_.put()));
    check(MatCreateVecs(rows_, nullptr, own_.put()));
  }

  void multiply(Vec x, Vec y) {
    check(VecScatterBegin(fetch_, x, theirs_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(fetch_, x, theirs_, INSERT_VALUES, SCATTER_FORWARD));
    PetscScalar* out = nullptr;
    check(VecGetArrayWrite(y, &out));
    check(VecPlaceArray(own_, out));
    check(MatMult(rows_, theirs_, own_));
    check(VecResetArray(own_));
    check(VecRestoreArrayWrite(y, &out));
  }

 private:
  Mat rows_ = nullptr;
  OwnedVec theirs_, own_;
  Owned<VecScatter, VecScatterDestroy> fetch_;
};

}  // namespace

double damping(Mat A) {
  constexpr int kSteps = 20;        // from numbers at random: within 5 % on all levels tried
  constexpr double kAbove = 1.15;
  if (ranks_of(A).alone()) return 1;
  OwnedVec scale, x, y;
  check(MatCreateVecs(A, x.put(), y.put()));
  check(VecDuplicate(x, scale.put()));
  check(MatGetDiagonal(A, scale));
  check(VecSqrtAbs(scale));
  check(VecReciprocal(scale));
  Between between(A, x);
  PetscReal size = 0;
  check(VecSetRandom(x, nullptr));
  for (int k = 0; k < kSteps; ++k) {
    check(VecNormalize(x, nullptr));
    check(VecPointwiseMult(x, x, scale));
    between.multiply(x, y);
    check(VecPointwiseMult(x, y, scale));
    check(VecNorm(x, NORM_2, &size));
    if (size == 0) break;
  }
  return std::min(1.0, 2 / (1 + kAbove * size));
}

}  // namespace dotyk::multigrid
