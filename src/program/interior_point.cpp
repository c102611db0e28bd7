#include "program/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/active_set.hpp"
#include "program/barrier.hpp"
#include "program/certificate.hpp"
#include "program/kkt.hpp"
#include "program/scaling.hpp"

namespace dotyk::program {
namespace {

/// Residual at which iterates that do not get better are still taken for the solution, relative to `tol`.
constexpr double kEnough = 100;
/// Iterations without a better one before it is called so.
constexpr int kPatience = 15;
/// Iterates that grow by this go to infinity, which proves why there is no better one once they are far enough.
constexpr double kGrows = 1.5;
/// The same where residuals and gap are small enough.
constexpr int kFinerPatience = 2;

/// Least regularisation of the KKT matrix, in units of a scaled program.
constexpr double kBarrierRegularisation = 1e-12;

/// The barrier of a (scaled) program, w its activities Ax: quasidefinite KKT systems with refinement.
class ProgramBarrier final : public Barrier {
 public:
  /// Multipliers start `far` inside: too near zero they shrink the first steps.
  ProgramBarrier(const QuadraticProgram& p, double far)
      : Barrier(p.low, p.high), p_(p), n_(p.unknowns()), kkt_(p), taken_(rows(), 0), theta_inverse_(Vector::Ones(rows())) {
    Vector b(n_ + rows());
    b << -p.q, Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      taken_[r] = std::isfinite(p.low[r]) || std::isfinite(p.high[r]);
      if (p.equality(r)) size_b_ = std::max(size_b_, std::abs(p.low[r])), theta_inverse_[r] = 0;
      if (taken_[r]) b[n_ + r] = std::clamp(0.0, p.low[r], p.high[r]);
    }
    Vector z = Vector::Zero(n_ + rows());
    if (factor_from(1)) {
      regular_ = kBarrierRegularisation;
      z = kkt_.solve(b);
    }
    at_.x = z.head(n_);
    const Vector Ax = p.A * at_.x, y = z.tail(rows());
    const Vector out = sign_.cwiseProduct(limit_ - Ax(row_)).cwiseMax(0), pull = -sign_.cwiseProduct(y(row_));
    place(Ax, std::max(1.0, 1.5 * peak(out)), 1);
    at_.z = far * std::max(1.0, 0.5 * peak(pull)) + pull.array().max(0);
    for (int r = 0; r < rows(); ++r) at_.y[r] = taken_[r] ? y[r] : 0;
    take_multipliers(at_);
  }

  void evaluate() override {
    Barrier::evaluate();
    const Vector Px = times(p_.P, at_.x);
    rd_ = Px + p_.q + p_.A.transpose() * at_.y;
    rp_ = p_.A * at_.x;
    for (int r = 0; r < rows(); ++r) rp_[r] = !taken_[r] ? 0 : rp_[r] - (p_.equality(r) ? p_.low[r] : at_.w[r]);
    primal_ = std::max(peak(rp_), peak(rs_));
    // Residuals count by what they may change of the objective, too: multipliers can be huge.
    gap_ = complementary_ + std::abs(rd_.dot(at_.x)) + rp_.cwiseAbs().dot(at_.y.cwiseAbs()) + rs_.cwiseAbs().dot(at_.z);
    energy_ = 0.5 * at_.x.dot(Px) + p_.q.dot(at_.x);
    gap_ /= 1 + std::abs(energy_);
  }

  /// Is in every pair one of s and z as small as `tol`? Their product is an energy, whatever the units: a gap of `tol` alone leaves unknowns off by
  /// its root.
  bool decided_to(double tol) const {
    return at_.s.size() == 0 || at_.s.cwiseProduct(at_.z).maxCoeff() <= tol * tol * (1 + std::abs(energy_));
  }

  /// The largest of the residuals, relative, and of the gap.
  double merit() const { return std::max({primal_ / (1 + size_b_), peak(rd_) / (1 + peak(p_.q)), gap_}); }

  /// Rows whose multiplier exceeds their slack at a point: the active set it predicts.
  std::vector<Side> active(const Point& at) const {
    std::vector<Side> side(rows(), Side::free);
    for (int r = 0; r < rows(); ++r)
      if (p_.equality(r)) side[r] = Side::equal;
    for (std::size_t k = 0; k < row_.size(); ++k)
      if (side[row_[k]] == Side::free && at.z[k] > at.s[k]) side[row_[k]] = sign_[k] > 0 ? Side::low : Side::high;
    return side;
  }

  int factorisations() const { return factorisations_; }

 private:
  /// Regularised no more than the pivots ask for: as many of them must be negative as there are rows.
  bool factor_from(double least) {
    for (regular_ = least; regular_ <= 1; regular_ *= 10) {
      ++factorisations_;
      if (kkt_.factor(regular_, (regular_ + theta_inverse_.array()).matrix(), taken_)) return true;
    }
    return false;
  }

  bool factor(const Vector& theta) override {
    for (int r = 0; r < rows(); ++r) theta_inverse_[r] = limited_[r] ? 1 / theta[r] : 0;
    return factor_from(std::max(kBarrierRegularisation, 0.1 * regular_));
  }

  /// Solves [P Aᵀ; A −Θ⁻¹] (dx, dy) = (−r_d, −r_p − Θ⁻¹κ), refined; dw = Θ⁻¹(dy − κ).
  void solve(const Vector& kappa, Point& d) override {
    Vector b(n_ + rows());
    b << -rd_, -rp_ - kappa.cwiseProduct(theta_inverse_);
    for (int r = 0; r < rows(); ++r)
      if (!taken_[r]) b[n_ + r] = 0;
    const auto K = [&](const Vector& z) {
      Vector out = kkt_times(p_, taken_, z);
      for (int r = 0; r < rows(); ++r) out[n_ + r] = taken_[r] ? out[n_ + r] - theta_inverse_[r] * z[n_ + r] : -z[n_ + r];
      return out;
    };
    const Vector z = refine(K, [&](const Vector& v) { return kkt_.solve(v); }, b, 1e-12 * peak(b), 4).z;
    d.x = z.head(n_), d.y = z.tail(rows());
    d.w = (d.y - kappa).cwiseProduct(theta_inverse_);
  }

  const QuadraticProgram& p_;
  int n_, factorisations_ = 0;
  Kkt kkt_;
  std::vector<char> taken_;
  Vector theta_inverse_, rd_, rp_;  ///< rd_, rp_: residuals of stationarity and of Ax = w
  double regular_ = 0, primal_ = 0, gap_ = 0, energy_ = 0, size_b_ = 0;
};

/// Iterates that go to infinity show a direction that proves why.
bool diverged(const QuadraticProgram& p, const Barrier& barrier, Result& result) {
  for (const Vector* y : {&barrier.point().y, &barrier.last().y})
    if (proves_infeasible(p, *y)) {
      result.end(Status::infeasible, "the rows contradict one another", *y / peak(*y));
      return true;
    }
  for (const Vector* x : {&barrier.point().x, &barrier.last().x})
    if (proves_unbounded(p, *x)) {
      result.end(Status::unbounded, kFallsForEver, *x / peak(*x));
      return true;
    }
  return false;
}

/// One run from a start with multipliers `far` inside; iterations are counted on from those `done`.
Result run(const QuadraticProgram& p, const InteriorPoint& settings, double far, int done, Monitor& monitor) {
  Result result;
  result.iterations = done;
  Stopwatch clock;
  ProgramBarrier barrier(p, far);
  Barrier::Point best = barrier.point();
  double least = INFINITY, size = INFINITY;
  int since_best = 0;
  result.reason = text("no end within ", settings.max_iterations, " iterations");
  for (int k = done; k < settings.max_iterations; ++k) {
    barrier.evaluate();
    const double merit = barrier.merit();
    const double last = std::exchange(size, std::max(peak(barrier.point().x), peak(barrier.point().y)));
    if (merit < least) {
      least = merit, best = barrier.point();
      since_best = 0;
    } else if (size <= kGrows * last && ++since_best > (least <= settings.tol ? kFinerPatience : kPatience)) {
      if (least <= kEnough * settings.tol) result.end(Status::solved, text("residuals and gap have stopped falling at ", least));
      else result.reason = text("the residual has stopped falling at ", least);
      break;
    }
    result.iterations = k + 1;
    monitor.iteration({.iteration = k + 1, .residual = merit, .seconds = clock.seconds()});
    if (merit <= settings.tol && barrier.decided_to(settings.tol) && (!settings.fine || settings.fine(barrier.point().x, barrier.point().y))) {
      best = barrier.point();
      result.end(Status::solved, text("residuals and gap are below ", settings.tol));
      break;
    }
    if (k - done > 2 && diverged(p, barrier, result)) break;
    if (monitor.stop()) {
      result.reason = "stopped on request";
      break;
    }
    if (!barrier.step()) {
      if (!diverged(p, barrier, result)) result.reason = "the KKT system could not be factored";
      break;
    }
  }
  // Rows without an interior (an equality that another implies as an inequality) have multipliers without bound. What
  // rounding of Aᵀy leaves of stationarity, in the measure of the merit:
  const double terms = peak(p.A.cwiseAbs().transpose() * best.y.cwiseAbs());
  const double lost = std::numeric_limits<double>::epsilon() * terms / (1 + peak(p.q));
  if (result.status == Status::solved && lost > kEnough * settings.tol)
    result.end(Status::stopped, text("the multipliers have grown until their rounding leaves a residual of ", lost,
                                     ": the rows have no interior"));
  result.factorisations = barrier.factorisations();
  result.x = best.x;
  result.y = best.y;
  result.working = barrier.active(best);
  return result;
}

/// In units of its own.
Result attempt(const Scaled& scaled, const InteriorPoint& settings, Monitor& monitor) {
  InteriorPoint inner = settings;
  if (settings.fine) inner.fine = [&](const Vector& x, const Vector& y) { return settings.fine(scaled.x(x), scaled.y(y)); };
  Result result = run(scaled.program, inner, 30, 0, monitor);
  if (result.status == Status::stopped && result.iterations < settings.max_iterations && !monitor.stop()) {
    result = run(scaled.program, inner, 1000, result.iterations, monitor);
    result.reason += ", at the second start";
  }
  if (result.status == Status::unbounded) {  // or without any point, which shows where the objective is strictly convex
    inner.fine = nullptr;
    const Result nearest = run(nearest_point(scaled.program), inner, 30, result.iterations, monitor);
    result.iterations = nearest.iterations;
    if (nearest.status != Status::solved) result.end(nearest.status, nearest.reason, nearest.direction);
  }
  scaled.take_back(result);
  return result;
}

/// Active sets from this result on. They find unknowns of little energy, for which slack and multiplier of a row differ only far below tol.
/// Returns `from` if that is no worse.
Result by_active_sets(const QuadraticProgram& program, const Result& from, Monitor& monitor) {
  ActiveSet settings;
  settings.start = ActiveSet::Start::cold;
  settings.working = from.working, settings.point = from.x;
  Result result = solve(program, settings, monitor);
  const auto off = [&](const Result& r) { return imbalance(program, r.x, r.y, Rounding::own); };
  if (result.status != Status::solved || (from.status == Status::solved && off(result) > off(from))) return from;
  result.iterations += from.iterations, result.factorisations += from.factorisations;
  result.reason = from.reason + "; then by active sets: " + result.reason;
  return result;
}

}  // namespace

Result solve(const QuadraticProgram& program, const InteriorPoint& settings, Monitor& monitor) {
  check(program);
  Stopwatch clock;
  Result result;
  const Vector curved = negative_curvature(program.P);
  if (curved.size()) {
    const double curvature = curved.dot(times(program.P, curved));
    result.end(Status::not_convex,
               text("the quadratic matrix has negative curvature: v'Pv = ", curvature, " for a v of length 1"), curved);
    result.x = Vector::Zero(program.unknowns()), result.y = Vector::Zero(program.rows());
  } else {
    result = attempt(scale(program), settings, monitor);
    const auto off = [&](const Result& r, Rounding nothing) { return imbalance(program, r.x, r.y, nothing); };
    const double most = std::max(kImbalanced, settings.tol);
    bool hidden = false;
    if (result.status == Status::solved && off(result, Rounding::own) > most) {
      InteriorPoint finer = settings;
      finer.fine = [&](const Vector& x, const Vector& y) {
        return imbalance(program, x, y, Rounding::own) <= most && (!settings.fine || settings.fine(x, y));
      };
      if (const auto other_units = scale_by_curvature(program)) {
        const Result other = attempt(*other_units, finer, monitor);
        if (other.status == Status::solved && off(other, Rounding::own) < off(result, Rounding::own)) result = other;
      }
      hidden = off(result, Rounding::of_greatest) > kHidden;
    }
    if (hidden) result = by_active_sets(program, result, monitor);
    if (hidden && off(result, Rounding::of_greatest) > kHidden) result.end(Status::stopped, kHiddenReason);
  }
  measure(program, result);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace dotyk::program
