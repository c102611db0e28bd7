#include "algebra/krylov/repeated_systems.hpp"

#include <algorithm>
#include <optional>

#include "algebra/krylov/block_cg.hpp"
#include "algebra/krylov/cglan.hpp"
#include "algebra/direct/cholesky.hpp"
#include "algebra/krylov/successive_cg.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"

namespace dotyk::algebra {

using Method = RepeatedSettings::Method;

struct RepeatedSystems::Implementation {
  const SparseMatrix& K;
  RepeatedSettings settings;
  std::optional<Cholesky> cholesky;
  std::unique_ptr<Preconditioner> preconditioner;
  std::optional<SuccessiveCg> scg;
  std::optional<Cglan> cglan;
  std::vector<SystemResult> results;
  double setup = 0;

  CgResult solve_one(const Vector& b, Monitor& monitor) {
    if (scg) return scg->solve(b, monitor);
    if (cglan) return cglan->solve(b, monitor);
    return conjugate_gradient(*preconditioner, b, settings.cg, monitor);
  }

  DenseMatrix in_turn(const DenseMatrix& B, Monitor& monitor) {
    DenseMatrix x = DenseMatrix::Zero(B.rows(), B.cols());
    for (Eigen::Index k = 0; k < B.cols(); ++k) {
      Stopwatch watch;
      const CgResult r = solve_one(B.col(k), monitor);
      x.col(k) = r.x;
      results.push_back({r.iterations, watch.seconds(), r.residual, r.converged, r.reason});
    }
    return x;
  }

  DenseMatrix as_block(const DenseMatrix& B, Monitor& monitor) {
    Stopwatch watch;
    BlockCgResult r = block_cg(*preconditioner, B, settings.cg, monitor);
    const double share = watch.seconds() / std::max<double>(1, static_cast<double>(B.cols()));
    for (std::size_t k = 0; k < r.settled.size(); ++k)
      results.push_back({r.settled[k] < 0 ? r.iterations : r.settled[k], share, r.residual[k],
                         r.residual[k] <= settings.cg.tolerance, r.reason});
    return std::move(r.x);
  }

  DenseMatrix directly(const DenseMatrix& B) {
    Stopwatch watch;
    DenseMatrix x = cholesky->solve(B);
    const double share = watch.seconds() / std::max<double>(1, static_cast<double>(B.cols()));
    const DenseMatrix r = B - DenseMatrix(K.selfadjointView<Eigen::Lower>() * x);
    for (Eigen::Index k = 0; k < B.cols(); ++k) {
      const double size = B.col(k).norm();
      results.push_back({0, share, size > 0 ? r.col(k).norm() / size : 0, true, "direct"});
    }
    return x;
  }
};

RepeatedSystems::RepeatedSystems(const SparseMatrix& lower, const std::vector<int>& node, const RepeatedSettings& settings)
    : it_(new Implementation{.K = lower, .settings = settings, .cholesky = {}, .preconditioner = {}, .scg = {}, .cglan = {}, .results = {}}) {
  Stopwatch watch;
  if (settings.method == Method::cholesky) {
    it_->cholesky.emplace(lower, node, std::vector<int>{});
    if (!it_->cholesky->factor(lower))
      throw InputError(text("the matrix is not positive definite: the pivot of unknown ", it_->cholesky->failed_unknown() + 1, " is not positive"));
  } else {
    it_->preconditioner = make_preconditioner(settings.preconditioning, lower, settings.omega);
  }
  it_->setup = watch.seconds();
  if (settings.method == Method::scg) it_->scg.emplace(*it_->preconditioner, settings.cg, settings.extend);
  if (settings.method == Method::cglan) it_->cglan.emplace(*it_->preconditioner, settings.cg, settings.deflate);
}

RepeatedSystems::~RepeatedSystems() = default;

DenseMatrix RepeatedSystems::solve(const DenseMatrix& B, Monitor& monitor) {
  if (B.rows() != it_->K.rows()) throw InputError(text("the right-hand sides have ", B.rows(), " rows, the matrix ", it_->K.rows()));
  if (!B.allFinite()) throw InputError("a right-hand side is not finite");
  if (it_->cholesky) return it_->directly(B);
  return it_->settings.method == Method::block_cg ? it_->as_block(B, monitor) : it_->in_turn(B, monitor);
}

const std::vector<SystemResult>& RepeatedSystems::results() const { return it_->results; }
double RepeatedSystems::setup_seconds() const { return it_->setup; }

double RepeatedSystems::bytes() const {
  if (it_->cholesky) return it_->cholesky->bytes();
  const double vectors = it_->scg ? it_->scg->basis().bytes() : it_->cglan ? it_->cglan->greatest_bytes() : 0;
  return it_->preconditioner->bytes() + vectors;
}

int RepeatedSystems::kept() const {
  if (it_->scg) return static_cast<int>(it_->scg->basis().count());
  return it_->cglan ? static_cast<int>(it_->cglan->basis().count()) : 0;
}

}  // namespace dotyk::algebra
