#include "solver/feti/dual_problem.hpp"

#include <algorithm>

#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "solver/feti/equal_pieces.hpp"
#include "solver/feti/factor_pieces.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Entries of all copies that rows touch.
Vector touched(const TornProblem& torn, const Vector& v) {
  Vector result(torn.B.cols());
  for (const Piece& p : torn.pieces)
    for (std::size_t i = 0; i < p.touched.size(); ++i) result[p.first_touched + i] = v[p.first + p.touched[i]];
  return result;
}

/// The other way round: zero where no row touches.
Vector spread(const TornProblem& torn, const Vector& t) {
  Vector result = Vector::Zero(torn.copies());
  for (const Piece& p : torn.pieces)
    for (std::size_t i = 0; i < p.touched.size(); ++i) result[p.first + p.touched[i]] = t[p.first_touched + i];
  return result;
}

}  // namespace

DualProblem::DualProblem(const problem::Problem& problem, algebra::Ordering ordering, problem::Clock& clock,
                         Monitor& monitor) {
  Stopwatch watch;
  monitor.phase("tearing the problem into pieces");
  torn_ = tear(problem);
  kinds_ = equal_pieces(torn_.pieces);
  kind_of_.resize(torn_.pieces.size());
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
    for (int p : kinds_[kind]) kind_of_[p] = static_cast<int>(kind);
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
  factor_in_threads(flops, "factoring piece", monitor, [&](int kind) {
    const Piece& first = torn_.pieces[kinds_[kind].front()];
    if (!inverses_[kind].factor(*first.K)) refuse_singular(first, inverses_[kind].failed_unknown());
  });
}

void DualProblem::add_modes() {
  load_.resize(torn_.copies());
  int modes = 0;
  for (std::size_t p = 0; p < torn_.pieces.size(); ++p) {
    load_.segment(torn_.pieces[p].first, torn_.pieces[p].size()) = *torn_.pieces[p].f;
    first_mode_.push_back(modes);
    modes += static_cast<int>(basis(p).cols());
  }
  e_.resize(modes);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < torn_.pieces.size(); ++p) {
    const Piece& piece = torn_.pieces[p];
    const DenseMatrix& R = basis(p);
    e_.segment(first_mode_[p], R.cols()) = R.transpose() * *piece.f;
    for (Eigen::Index j = 0; j < R.cols(); ++j)
      for (std::size_t i = 0; i < piece.touched.size(); ++i)
        entries.emplace_back(first_mode_[p] + j, piece.first_touched + i, R(piece.touched[i], j));
  }
  SparseMatrix on_touched(modes, torn_.B.cols());
  on_touched.setFromTriplets(entries.begin(), entries.end());
  G_ = on_touched * SparseMatrix(torn_.Bt);
}

Vector DualProblem::apply(const Vector& lambda) const {
  return torn_.B * touched(torn_, inverse(spread(torn_, torn_.Bt * lambda))) + torn_.compliance.cwiseProduct(lambda);
}

Vector DualProblem::inverse(const Vector& f) const {
  return on_pieces(torn_, batches_, f, [this](const Batch& batch, DenseMatrix& columns) {
    columns = inverses_[batch.kind].apply(columns);
  });
}

Vector DualProblem::elastic(const Vector& lambda) const {
  Vector force = load_ - spread(torn_, torn_.Bt * lambda);
  for (std::size_t p = 0; p < torn_.pieces.size(); ++p) {
    auto own = force.segment(torn_.pieces[p].first, torn_.pieces[p].size());
    own -= basis(p) * (basis(p).transpose() * own);
  }
  return inverse(force);
}

Vector DualProblem::moved(Vector v, const Vector& alpha) const {
  for (std::size_t p = 0; p < torn_.pieces.size(); ++p)
    v.segment(torn_.pieces[p].first, torn_.pieces[p].size()) +=
        basis(p) * alpha.segment(first_mode_[p], basis(p).cols());
  return v;
}

Vector DualProblem::jump(const Vector& v) const { return torn_.B * touched(torn_, v) - torn_.c; }

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
