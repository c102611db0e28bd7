#include "program/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/active_set_iteration.hpp"
#include "program/certificate.hpp"
#include "program/interior_point.hpp"
#include "program/scaling.hpp"

namespace dotyk::program {
namespace {

constexpr double kStationary = 1e-6;  ///< gradient left at a solution, beside the data
constexpr double kFeasible = 1e-7;    ///< relative violation with which a solution is still one
constexpr double kBroken = 0.01;      ///< one with which a point is none, whatever its units

ActiveSetStart equalities(const QuadraticProgram& p) {
  ActiveSetStart start{std::vector<Side>(p.rows(), Side::free), Vector::Zero(p.unknowns()), Vector::Zero(p.rows())};
  for (int r = 0; r < p.rows(); ++r)
    if (p.equality(r)) start.working[r] = Side::equal;
  return start;
}

ActiveSetStart guess(const QuadraticProgram& p, const Scaled& scaled, const ActiveSet& settings, Monitor& monitor, Result& predicted) {
  ActiveSetStart g = equalities(p);
  const bool small = p.unknowns() + p.rows() <= 200;
  if (!settings.working.empty()) g.working = settings.working;
  else if (settings.start == ActiveSet::Start::interior_point || (settings.start == ActiveSet::Start::automatic && !small)) {
    predicted = solve(p, InteriorPoint{}, monitor);
    if (predicted.status == Status::infeasible || predicted.status == Status::unbounded || !predicted.x.allFinite()) return g;
    g.working = predicted.working;
    g.x = predicted.x.cwiseQuotient(scaled.column);
    g.y = scaled.cost * predicted.y.cwiseQuotient(scaled.row);
  }
  if (settings.point.size() > 0) g.x = settings.point.cwiseQuotient(scaled.column);
  return g;
}

/// Where the solution is 0 in all unknowns of the rows, a violation has nothing to be compared with but their rounding. Sets
/// unknowns that are 0 to the tolerance to 0 where the multipliers found prove that this is a solution.
bool solved_by_zeros(const QuadraticProgram& p, const ActiveSet& settings, Result& result) {
  const double rounding = settings.tol * (1 + peak(result.x));
  const Vector x = (result.x.array().abs() <= rounding).select(0.0, result.x);
  const Residuals at = residuals(p, x, result.y);
  if (!(std::max({at.stationarity, at.feasibility, at.complementarity}) <= settings.tol)) return false;
  result.x = x;
  return true;
}

/// Far away rounding hides that rows contradict one another: is there any feasible point?
void doubt(const QuadraticProgram& p, const ActiveSet& settings, Monitor& monitor, Result& result) {
  const double violation = result.status == Status::solved ? residuals(p, result.x, result.y).feasibility : 0;
  if (violation > settings.tol && solved_by_zeros(p, settings, result)) return;
  const bool violated = violation > kFeasible;
  if (!violated && result.status != Status::unbounded) return;
  const QuadraticProgram nearest = nearest_point(p);
  ActiveSet one_by_one = settings;
  one_by_one.change = ActiveSet::Change::one;
  const Result point = iterate(nearest, one_by_one, equalities(p), monitor);
  result.iterations += point.iterations, result.singular += point.singular, result.survived += point.survived;
  if (point.status == Status::infeasible) result.end(point.status, point.reason, point.direction);
  else if (violated) result.end(Status::stopped, "rows stay violated: the working set is too ill-conditioned");
}

/// Far away rounding hides the gradient as well: beside the terms Px of a huge x nothing is left of q. The objective
/// then falls for ever along x, or no more is known.
void doubt_stationarity(const QuadraticProgram& p, Result& result) {
  if (result.status != Status::solved) return;
  const Vector pull = p.A.transpose() * result.y;
  const double left = peak(times(p.P, result.x) + p.q + pull);
  if (left <= kStationary * (1 + peak(p.q) + peak(p.A.cwiseAbs().transpose() * result.y.cwiseAbs()))) return;
  const Vector along = result.x / peak(result.x);
  if (proves_unbounded(p, along)) result.end(Status::unbounded, kFallsForEver, along);
  else result.end(Status::stopped, "the unknowns have grown beyond the digits of the gradient");
}

/// ": rows 1, 4 and 7" of a proof of infeasibility.
std::string name_rows(const Vector& weights) {
  constexpr int most = 6;
  std::string out;
  int count = 0;
  const double least = 1e-6 * peak(weights);
  for (int r = 0; r < weights.size(); ++r)
    if (std::abs(weights[r]) > least && ++count <= most) out += text(count > 1 ? ", " : ": rows ", r + 1);
  return count > most ? out + text(" and ", count - most, " more") : out;
}

/// Unknowns held by a single-entry row at work are on their bound to the last digit.
void put_on_bounds(const QuadraticProgram& p, Result& result) {
  for (int r = 0; r < p.rows(); ++r) {
    const Side side = result.working[r];
    if (side == Side::free || p.A.outerIndexPtr()[r + 1] - p.A.outerIndexPtr()[r] != 1) continue;
    const SparseRows::InnerIterator entry(p.A, r);
    if (entry.value() != 0) result.x[entry.col()] = (side == Side::low ? p.low[r] : p.high[r]) / entry.value();
  }
}

/// In units of its own.
Result attempt(const QuadraticProgram& program, const Scaled& scaled, const ActiveSet& settings, Monitor& monitor) {
  Result predicted;
  const ActiveSetStart start = guess(program, scaled, settings, monitor, predicted);
  Result result = iterate(scaled.program, settings, start, monitor);
  doubt_stationarity(scaled.program, result);
  doubt(scaled.program, settings, monitor, result);
  scaled.take_back(result);
  if (result.status == Status::infeasible) result.reason += name_rows(result.direction);
  if (result.status == Status::solved) put_on_bounds(program, result);
  result.predictor_iterations = predicted.iterations;
  result.factorisations += predicted.factorisations;
  return result;
}

}  // namespace

Result solve(const QuadraticProgram& program, const ActiveSet& settings, Monitor& monitor) {
  check(program);
  Stopwatch clock;
  const Vector curved = negative_curvature(program.P);
  if (curved.size()) return solve(program, InteriorPoint{}, monitor);
  Result result = attempt(program, scale(program), settings, monitor);
  const auto off = [&](const Result& r) { return r.status == Status::solved ? imbalance(program, r.x, r.y) : INFINITY; };
  const bool may_go_on = result.iterations < settings.max_iterations && !monitor.stop();
  if (const bool ended = result.status == Status::solved || (result.status == Status::stopped && may_go_on); ended && off(result) > kImbalanced)
    if (const auto units = scale_by_curvature(program)) {
      Result other = attempt(program, *units, settings, monitor);
      if (off(other) < off(result)) result = std::move(other);
      if (settings.start == ActiveSet::Start::automatic && settings.working.empty() && off(result) > kHidden) {
        ActiveSet predicted = settings;
        predicted.start = ActiveSet::Start::interior_point;
        if (other = attempt(program, *units, predicted, monitor); off(other) < off(result)) result = std::move(other);
      }
    }
  if (result.status == Status::solved && off(result) > kHidden) result.end(Status::stopped, kHiddenReason);
  measure(program, result);
  // Units in which a row is kept may differ from its own by the range of numbers; but x may be nothing but rounding.
  const Residuals& at = result.residual;
  if (result.status == Status::solved && at.feasibility > kBroken && at.feasibility_scale > settings.tol * (1 + peak(result.x)))
    result.end(Status::stopped, "rows stay violated: units of unknowns are too far apart");
  result.seconds = clock.seconds();
  return result;
}

}  // namespace dotyk::program
