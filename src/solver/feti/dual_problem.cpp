#include "solver/feti/dual_problem.hpp"

#include "algebra/direct/blas_threads.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

DualProblem::DualProblem(const problem::Problem& problem, algebra::Ordering ordering, problem::Clock& clock,
                         Monitor& monitor) {
  Stopwatch watch;
  monitor.phase("tearing the problem into pieces");
  torn_ = tear(problem);
  kinds_ = equal_pieces(torn_.pieces);
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
    for (int p : kinds_[kind]) torn_.pieces[p].kind = static_cast<int>(kind);
  batches_ = batches(kinds_, torn_.pieces);
  clock.assembly += watch.lap();
  analyse(ordering, monitor);
  clock.ordering += watch.lap();
  factor(monitor);
  clock.factor += watch.lap();
  add_modes();
  d_ = jump(inverse(load_));
  clock.assembly += watch.lap();
}

void DualProblem::analyse(algebra::Ordering ordering, Monitor& monitor) {
  monitor.phase(text("ordering ", kinds_.size(), kinds_.size() == 1 ? " kind" : " kinds", " of ", torn_.pieces.size(),
                     " pieces"));
  for (const auto& kind : kinds_) {  // one after another: METIS draws its random numbers from the C library
    monitor.check();
    const Piece& first = torn_.pieces[kind.front()];
    inverses_.emplace_back(*first.K, *first.node, *first.kernel, ordering);
  }
  require_memory(factor_bytes(), text("the factors of ", kinds_.size(), " pieces"));
}

void DualProblem::factor(Monitor& monitor) {
  std::vector<double> flops;
  for (const auto& inverse : inverses_) flops.push_back(inverse.cholesky().flops());
  const auto phase = [&](int, int n) { return text("factoring piece ", n, " of ", flops.size()); };
  algebra::factor_in_threads(flops, phase, monitor, [&](int kind) {
    const Piece& first = torn_.pieces[kinds_[kind].front()];
    if (!inverses_[kind].factor(*first.K)) refuse_singular(first, inverses_[kind].failed_unknown());
  });
}

void DualProblem::add_modes() {
  load_.resize(torn_.copies());
  int modes = 0;
  for (Piece& piece : torn_.pieces) {
    load_.segment(piece.first, piece.size()) = *piece.f;
    piece.first_mode = modes;
    modes += static_cast<int>(basis(piece).cols());
  }
  e_.resize(modes);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Piece& piece : torn_.pieces) {
    const DenseMatrix& R = basis(piece);
    e_.segment(piece.first_mode, R.cols()) = R.transpose() * *piece.f;
    for (Eigen::Index j = 0; j < R.cols(); ++j)
      for (std::size_t i = 0; i < piece.touched.size(); ++i)
        entries.emplace_back(piece.first_mode + j, piece.first_touched + i, R(piece.touched[i], j));
  }
  SparseMatrix on_touched(modes, torn_.B.cols());
  on_touched.setFromTriplets(entries.begin(), entries.end());
  G_ = on_touched * SparseMatrix(torn_.Bt);
}

Vector DualProblem::apply(const Vector& lambda) const {
  const Vector moved = inverse(force(lambda));
  return torn_.B * moved(torn_.touched) + torn_.compliance.cwiseProduct(lambda);
}

Vector DualProblem::inverse(const Vector& f) const {
  return on_pieces(torn_, batches_, f, [this](const Batch& batch, DenseMatrix& columns) {
    columns = inverses_[batch.kind].apply(columns);
  });
}

/// B̂ᵀλ on all copies.
Vector DualProblem::force(const Vector& lambda) const {
  Vector result = Vector::Zero(torn_.copies());
  result(torn_.touched) = torn_.Bt * lambda;
  return result;
}

Vector DualProblem::elastic(const Vector& lambda) const {
  Vector left = load_ - force(lambda);
  for (const Piece& piece : torn_.pieces) {
    auto own = left.segment(piece.first, piece.size());
    own -= basis(piece) * (basis(piece).transpose() * own);
  }
  return inverse(left);
}

Vector DualProblem::moved(Vector v, const Vector& alpha) const {
  for (const Piece& piece : torn_.pieces)
    v.segment(piece.first, piece.size()) += basis(piece) * alpha.segment(piece.first_mode, basis(piece).cols());
  return v;
}

Vector DualProblem::jump(const Vector& v) const { return torn_.B * v(torn_.touched) - torn_.c; }

Vector DualProblem::on_blocks(const problem::Problem& problem, const Vector& resultants) const {
  const Vector force = moved(Vector::Zero(torn_.copies()), resultants);  // has these resultants, R̂ being orthonormal
  Vector sum = Vector::Zero(torn_.unknowns);
  for (int k = 0; k < torn_.copies(); ++k)
    if (torn_.unknown[k] >= 0) sum[torn_.unknown[k]] += force[k];
  std::vector<double> result;
  for (const problem::Block& block : problem.blocks)
    for (Eigen::Index mode = 0; mode < block.kernel.cols(); ++mode)
      result.push_back(block.kernel.col(mode).dot(sum.segment(block.first, block.size())));
  return Eigen::Map<const Vector>(result.data(), static_cast<Eigen::Index>(result.size()));
}

double DualProblem::factor_bytes() const {
  double bytes = 0;
  for (const auto& inverse : inverses_) bytes += inverse.cholesky().bytes();
  return bytes;
}

const std::string& DualProblem::ordering() const {
  static const std::string none;
  if (inverses_.empty()) return none;
  return std::max_element(inverses_.begin(), inverses_.end(), [](const auto& a, const auto& b) {
           return a.cholesky().flops() < b.cholesky().flops();
         })->cholesky().method();
}

}  // namespace dotyk::solver
