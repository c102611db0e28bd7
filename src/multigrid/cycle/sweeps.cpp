#include "multigrid/cycle/sweeps.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <utility>

namespace dotyk::multigrid {
namespace {

NodeBlock diagonal(const HalfMatrix& A, int node) {
  const int n = A.block();
  return Eigen::Map<const NodeBlock>(A.stored().diagonal.data() + static_cast<std::ptrdiff_t>(node) * n * n, n, n);
}

/// W D W.
NodeBlock weighted_diagonal(const HalfMatrix& A, int node, const std::vector<int>& solved) {
  const double weight = std::sqrt(8);  // with √1 quadratic elements take twice as many iterations on ranks, with √4 a tenth more, with √16 as many
  NodeBlock D = diagonal(A, node);
  for (int r = 0; r < A.block(); ++r)
    if (std::ranges::binary_search(solved, node * A.block() + r)) D.row(r) *= weight, D.col(r) *= weight;
  return D;
}

/// The matrix G⁻¹ A_between G⁻ᵀ, where W D W = G Gᵀ, on the nodes of this rank that are coupled to others. `weighted`: W D W of these nodes.
class Between {
 public:
  Between(HalfMatrix& A, const std::vector<NodeBlock>& weighted) : A_(A), all_(static_cast<std::size_t>(A.rows()), 0.0), product_(all_) {
    for (const NodeBlock& block : weighted) {
      Eigen::LLT<NodeBlock> factor(block);
      if (factor.info() != Eigen::Success) factor.compute((A.block() * block.diagonal().cwiseAbs()).asDiagonal());  // as in invert()
      factors_.push_back(std::move(factor));
    }
  }

  std::size_t count() const { return factors_.size() * static_cast<std::size_t>(A_.block()); }

  /// Collective.
  std::vector<double> times(const std::vector<double>& v) {
    std::vector<double> product(v.size());
    each_node([&](std::size_t k, double* all, double*) { of(all) = factors_[k].matrixU().solve(of(v.data() + k * A_.block())); });
    A_.times_others(all_.data(), [&](int node, const double* numbers) { std::copy_n(numbers, A_.block(), product_.begin() + node * A_.block()); });
    each_node([&](std::size_t k, double*, double* own) { of(product.data() + k * A_.block()) = factors_[k].matrixL().solve(of(own)); });
    return product;
  }

 private:
  Eigen::Map<Eigen::VectorXd> of(double* numbers) const { return {numbers, A_.block()}; }
  Eigen::Map<const Eigen::VectorXd> of(const double* numbers) const { return {numbers, A_.block()}; }
  template <class Work>
  void each_node(const Work& work) {
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      const auto first = static_cast<std::size_t>(A_.border()[k]) * A_.block();
      work(k, all_.data() + first, product_.data() + first);
    }
  }

  HalfMatrix& A_;
  std::vector<Eigen::LLT<NodeBlock>> factors_;  // of nodes of the border
  std::vector<double> all_, product_;           // by own rows
};

/// An approximate eigenvalue of a symmetric matrix. The matrix has an eigenvalue no further than `distance` from `value`.
struct Ritz {
  double value, distance;
};

/// The greatest Ritz value of Lanczos's method: the greatest eigenvalue of its tridiagonal matrix, with the entries `diagonal` and, next to it, `beside`. The last
/// number of `beside` is the norm β of the vector that the last step left. The distance is β |s|, where s is the last entry of the tridiagonal matrix's
/// eigenvector (Parlett, The Symmetric Eigenvalue Problem, 1998, §13.2).
Ritz greatest_ritz(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto count = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Map(diagonal.data(), count), Eigen::VectorXd::Map(beside.data(), count - 1));
  return {solver.eigenvalues()[count - 1], beside.back() * std::abs(solver.eigenvectors()(count - 1, count - 1))};
}

/// The greatest eigenvalue c, estimated from above. Collective.
double greatest_coupling(HalfMatrix& A, const std::vector<NodeBlock>& weighted) {
  constexpr int kMostSteps = 60;  // of Lanczos, from numbers at random; 8 to 25 suffice for all that was tried
  constexpr double kNear = 0.03, kAbove = 0.01;  // relative; a Ritz value comes from below
  const Ranks& ranks = A.ranks();
  Between between(A, weighted);
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); };
  std::minstd_rand numbers(1 + static_cast<unsigned>(ranks.own()));  // the same numbers on all ranks would be nearly orthogonal to the eigenvector, which changes its sign from rank to rank
  std::vector<double> v(between.count()), before(v.size()), diagonal, beside;
  for (double& number : v) number = std::uniform_real_distribution<>(-1, 1)(numbers);
  double size = std::sqrt(ranks.sum(dot(v, v)));  // of v; each step begins by dividing v by it
  Ritz greatest{0, 0};
  for (int k = 0; k < kMostSteps && size > 0; ++k) {
    for (double& number : v) number /= size;
    std::vector<double> w = between.times(v);
    if (k > 0)
      for (std::size_t i = 0; i < w.size(); ++i) w[i] -= size * before[i];
    const auto [on_v, square] = ranks.sum({dot(w, v), dot(w, w)});
    for (std::size_t i = 0; i < w.size(); ++i) w[i] -= on_v * v[i];
    size = std::sqrt(std::max(0.0, square - on_v * on_v));  // of w: ‖w − (w · v) v‖² = ‖w‖² − (w · v)²
    diagonal.push_back(on_v), beside.push_back(size);
    before = std::exchange(v, std::move(w));
    greatest = greatest_ritz(diagonal, beside);
    if (greatest.distance <= kNear * greatest.value) break;
  }
  return greatest.value + std::max(greatest.distance, kAbove * greatest.value);
}

}  // namespace

void Sweeps::set(const std::vector<char>& changed, const std::vector<int>& solved) {
  double greatest = 0;
  for (int row = 0; row < A_.rows(); ++row) greatest = std::max(greatest, A_.diagonal(row));
  const double unit = std::exp2(std::ilogb(greatest > 0 && std::isfinite(greatest) ? greatest : 1));
  const bool all = std::exchange(unit_, unit) != unit;
  const auto is_due = [&](int node) { return all || std::any_of(changed.begin() + node * A_.block(), changed.begin() + (node + 1) * A_.block(), std::identity()); };
  for (int node = 0; node < A_.nodes(); ++node)
    if (is_due(node)) take(node);
  // The damping depends on the borders of all ranks: all compute it anew, or none. At border nodes take() has left blocks without it.
  if (A_.ranks().all(solved == solved_ && std::ranges::none_of(A_.border(), is_due))) return;
  solved_ = solved;
  const std::vector<NodeBlock> damped = damped_blocks(A_, solved);
  for (std::size_t k = 0; k < damped.size(); ++k) invert(A_.block(), damped[k].data(), inverse_.data() + static_cast<std::ptrdiff_t>(A_.border()[k]) * A_.block() * A_.block());
  take_border();
}

void Sweeps::take(int node) {
  const HalfBlocks<double> of = A_.half();
  const std::ptrdiff_t square = of.size * of.size;
  for (std::ptrdiff_t k = of.starts[node] * square; k < of.starts[node + 1] * square; ++k) below_[k] = static_cast<float>(of.below[k] / unit_);
  invert(of.size, of.diagonal + node * square, inverse_.data() + node * square);
}

HalfBlocks<float> Sweeps::half() const {
  const HalfBlocks<double> of = A_.half();
  return {of.size, of.starts, of.columns, below_.data(), unit_, of.diagonal};
}

HalfBlocks<float> Sweeps::border() const { return {A_.block(), border_.starts, border_.columns.data(), border_.values.data(), unit_, A_.half().diagonal}; }

void Sweeps::forward(const double* b, double* x, double* left) {
  auto& [solution, residual] = A_.room();
  residual.take(b);
  sweep_forward(half(), inverse_.data(), solution, residual);
  take_off(residual, solution);
  if (moved_) {
    sweep_forward(border(), A_.border(), inverse_.data(), solution, residual, *moved_);
    take_off(residual, *moved_);
  }
  solution.give(x);
  residual.give(left);
}

void Sweeps::backward(const double* b, double* x) {
  auto& [solution, residual] = A_.room();
  residual.take(b);
  solution.take(x);
  if (moved_) {
    PaddedVector& beyond = *moved_;
    A_.times_others(solution, [&](int node, const double* numbers) { std::copy_n(numbers, A_.block(), beyond.of(node)); });
    sweep_backward(border(), A_.border(), inverse_.data(), residual, beyond, solution);
  }
  take_off(residual, solution);
  sweep_backward(half(), inverse_.data(), residual, solution);
  solution.give(x);
}

void Sweeps::take_off(PaddedVector& residual, const PaddedVector& x) {
  A_.times_others(x, [&](int node, const double* numbers) {
    double* own = residual.of(node);
    for (int r = 0; r < A_.block(); ++r) own[r] -= numbers[r];
  });
}

void Sweeps::take_border() {
  const int n = A_.block();
  border_.starts.assign(1, 0), border_.columns.clear(), border_.values.clear();  // their room is kept
  for (const int node : A_.border()) {
    A_.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
      if (other >= A_.nodes() || other == node) return;
      border_.columns.push_back(other);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) border_.values.push_back(static_cast<float>(A_.entry(block, read, r, c) / unit_));
    });
    border_.starts.push_back(counted(border_.columns.size()));
  }
  border_.values.resize(border_.values.size() + kSpare);
}

std::vector<NodeBlock> damped_blocks(HalfMatrix& A, const std::vector<int>& solved) {
  std::vector<NodeBlock> blocks;
  if (A.ranks().alone()) return blocks;
  for (const int node : A.border()) blocks.push_back(weighted_diagonal(A, node, solved));
  const double c = std::max(1.0, greatest_coupling(A, blocks));
  for (std::size_t k = 0; k < blocks.size(); ++k) blocks[k] = (diagonal(A, A.border()[k]) + c * blocks[k]) / 2;
  return blocks;
}

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
