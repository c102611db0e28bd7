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

/// The greatest eigenvalue of a symmetric tridiagonal matrix T, or 0 if that is negative. By bisection: T − x has only negative pivots exactly if x is
/// greater than all eigenvalues.
double greatest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  double bound = 0;
  for (const auto* entries : {&diagonal, &beside})
    for (const double entry : *entries) bound = std::max(bound, 3 * std::abs(entry));
  double high = bound;
  for (double low = 0; high - low > 1e-4 * bound;) {
    const double x = (low + high) / 2;
    double pivot = diagonal[0] - x;
    bool above = pivot < 0;
    for (std::size_t k = 1; above && k < diagonal.size(); ++k) above = (pivot = diagonal[k] - x - beside[k - 1] * beside[k - 1] / pivot) < 0;
    (above ? high : low) = x;
  }
  return high;
}

/// The diagonal of D^−1/2, with zeros at the rows `left_out`.
OwnedVec scaling(Mat A, const std::vector<int>& left_out) {
  OwnedVec out;
  PetscScalar* of = nullptr;
  check(MatCreateVecs(A, out.put(), nullptr));
  check(MatGetDiagonal(A, out));
  check(VecSqrtAbs(out));
  check(VecReciprocal(out));
  check(VecGetArray(out, &of));
  for (const int row : left_out) of[row] = 0;
  check(VecRestoreArray(out, &of));
  return out;
}

}  // namespace

double damping(Mat A, const std::vector<int>& solved) {
  constexpr int kSteps = 12;        // of Lanczos, from numbers at random: within 1 % on all levels tried
  constexpr double kAbove = 1.03;
  if (ranks_of(A).alone()) return 1;
  const OwnedVec scale = scaling(A, solved);
  OwnedVec v, before, w, scaled;
  for (OwnedVec* x : {&v, &before, &w, &scaled}) check(VecDuplicate(scale, x->put()));
  Between between(A, v);
  std::vector<double> diagonal, beside;
  check(VecSetRandom(v, nullptr));
  check(VecNormalize(v, nullptr));
  for (int k = 0; k < kSteps; ++k) {
    PetscScalar along = 0;
    PetscReal size = 0;
    check(VecPointwiseMult(scaled, v, scale));
    between.multiply(scaled, w);
    check(VecPointwiseMult(w, w, scale));
    check(VecDot(w, v, &along));
    check(VecAXPY(w, -along, v));
    if (k > 0) check(VecAXPY(w, -beside.back(), before));
    diagonal.push_back(along);
    check(VecCopy(v, before));
    check(VecCopy(w, v));
    check(VecNormalize(v, &size));
    if (size == 0) break;
    beside.push_back(size);
  }
  return std::min(1.0, 2 / (1 + kAbove * greatest_eigenvalue(diagonal, beside)));
}

}  // namespace dotyk::multigrid
