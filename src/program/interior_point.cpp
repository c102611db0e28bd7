#include "program/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/active_set.hpp"
#include "program/barrier.hpp"
#include "program/certificate.hpp"
#include "program/scaling.hpp"

namespace dotyk::program {
namespace {

/// Residual at which iterates that do not get better are still taken for the solution, relative to `tol`.
constexpr double kEnough = 100;
/// Unknowns and rows up to which active sets end it: exactly, in next to no time.
constexpr int kEndsExactly = 200;
/// Iterations without a better one before it is called so.
constexpr int kPatience = 15;
/// The same where all that is asked for yet is `fine`.
constexpr int kFinerPatience = 3;

/// Iterates that go to infinity show a direction that proves why.
bool diverged(const QuadraticProgram& p, const Barrier& barrier, Result& result) {
  for (const Vector* y : {&barrier.point().y, &barrier.last().y})
    if (proves_infeasible(p, *y)) {
      result.status = Status::infeasible;
      result.reason = "the rows contradict one another";
      result.direction = *y / y->lpNorm<Eigen::Infinity>();
      return true;
    }
  for (const Vector* x : {&barrier.point().x, &barrier.last().x})
    if (proves_unbounded(p, *x)) {
      result.status = Status::unbounded;
      result.reason = "the objective falls for ever along a direction that meets no row";
      result.direction = *x / x->lpNorm<Eigen::Infinity>();
      return true;
    }
  return false;
}

/// What rounding of Aᵀy leaves of stationarity, in the measure of the merit.
double rounding(const QuadraticProgram& p, const Vector& y) {
  return std::numeric_limits<double>::epsilon() * peak(p.A.cwiseAbs().transpose() * y.cwiseAbs()) / (1 + peak(p.q));
}

/// One run from a start with multipliers `far` inside; iterations are counted on from those `done`.
Result run(const QuadraticProgram& p, const InteriorPoint& settings, double far, int done, Monitor& monitor) {
  Result result;
  result.iterations = done;
  Stopwatch clock;
  Barrier barrier(p);
  barrier.start(far);
  Barrier::Point best = barrier.point();
  double least = INFINITY;
  int since_best = 0;
  result.reason = text("no end within ", settings.max_iterations, " iterations");
  for (int k = done; k < settings.max_iterations; ++k) {
    barrier.evaluate();
    const double merit = barrier.merit();
    if (merit < least) {
      least = merit, best = barrier.point();
      since_best = 0;
    } else if (++since_best > kPatience) {
      result.reason = text("the residual has stopped falling at ", least);
      break;
    }
    result.iterations = k + 1;
    monitor.iteration({.iteration = k + 1, .residual = merit, .seconds = clock.seconds()});
    const bool within = least <= settings.tol;
    if (within && settings.fine && since_best >= kFinerPatience) break;  // as fine as it gets
    if (merit <= settings.tol && (!settings.fine || settings.fine(barrier.point().x, barrier.point().y))) {
      best = barrier.point();
      result.status = Status::solved;
      result.reason = text("residuals and gap are below ", settings.tol);
      break;
    }
    if (k - done > 2 && diverged(p, barrier, result)) break;
    if (monitor.stop()) {
      result.reason = "stopped on request";
      break;
    }
    if (!barrier.step()) {
      result.reason = "the KKT system could not be factored";
      break;
    }
  }
  if (result.status == Status::stopped && least <= kEnough * settings.tol) {
    result.status = Status::solved;
    result.reason = text("residuals and gap have stopped falling at ", least);
  }
  // Rows without an interior (an equality that another implies as an inequality) have multipliers without bound.
  if (const double lost = rounding(p, best.y); result.status == Status::solved && lost > kEnough * settings.tol) {
    result.status = Status::stopped;
    result.reason = text("the multipliers have grown until their rounding leaves a residual of ", lost, ": the rows have no interior");
  }
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
    if (nearest.status == Status::infeasible) {
      result.status = nearest.status, result.reason = nearest.reason, result.direction = nearest.direction;
    }
  }
  result.x = scaled.x(result.x);
  result.y = scaled.y(result.y);
  if (result.status == Status::unbounded) result.direction = scaled.x(result.direction).normalized();
  if (result.status == Status::infeasible) result.direction = scaled.row.cwiseProduct(result.direction);
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
    result.status = Status::not_convex;
    result.reason = text("the quadratic matrix has negative curvature: v'Pv = ", curved.dot(times(program.P, curved)),
                         " for a v of length 1");
    result.direction = curved;
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
    const bool few = !settings.fine && !monitor.stop() && program.unknowns() + program.rows() <= kEndsExactly;
    if (hidden || (few && (result.status == Status::solved || result.status == Status::stopped))) result = by_active_sets(program, result, monitor);
    if (hidden && off(result, Rounding::of_greatest) > kHidden) result.status = Status::stopped, result.reason = kHiddenReason;
  }
  measure(program, result);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace dotyk::program
