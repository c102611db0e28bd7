#include "shape/optimise/scaled_problem.hpp"

#include <cmath>

#include "base/error.hpp"
#include "shape/optimise/linear_program.hpp"

namespace dotyk::shape {
namespace {

/// A design that moves no more with a gap above this is stuck, at a kink say, and not converged.
constexpr double kStuck = 1e-3;

void check(const DesignProblem& problem, const Vector& start) {
  const Eigen::Index n = start.size();
  if (problem.lower.size() != n || problem.upper.size() != n)
    throw InputError(text(n, " design variables with ", problem.lower.size(), " lower and ", problem.upper.size(), " upper bounds"));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double l = problem.lower[i], u = problem.upper[i];
    if (!std::isfinite(l) || !std::isfinite(u) || l > u)
      throw InputError(text("design variable ", i + 1, " is bounded by ", l, " and ", u, "; both must be numbers, the lower one first"));
    if (!(start[i] >= l && start[i] <= u))
      throw InputError(text("design variable ", i + 1, " starts at ", start[i], ", outside its bounds ", l, " and ", u));
  }
}

void check(const Stopping& s) {
  if (!(s.tol_design > 0) || !(s.tol_gap >= 0) || !(s.tol_violation >= 0) || s.max_designs < 1)
    throw InputError(text("tolerances must be positive (design ", s.tol_design, ", gap ", s.tol_gap, ", violation ", s.tol_violation,
                          ") and at least one design allowed (", s.max_designs, ")"));
}

Stationarity stationarity(const ScaledDesign& design) {
  const Evaluation& v = design.value;
  const Eigen::Index n = design.x.size();
  const Vector room = (-v.constraints).cwiseMax(0.0);
  const LinearSolution s = minimise({v.gradient, v.jacobian, room, -design.x, Vector::Ones(n) - design.x});
  if (s.status != LinearStatus::solved) return {INFINITY, Vector::Zero(room.size())};  // d = 0 is a point: the simplex method broke down
  return {std::max(0.0, -s.value), s.y};
}

}  // namespace

ScaledProblem::ScaledProblem(const DesignProblem& problem, const Vector& start, const Stopping& stopping, Monitor& monitor)
    : problem_(problem), stopping_(stopping), monitor_(monitor) {
  check(problem, start);
  check(stopping);
  range_ = problem.upper - problem.lower;
  const auto given = problem.evaluate(start);
  if (!given) throw InputError("the first design is not admissible: start from one that is");
  const Evaluation value = checked(start, *given);
  objective_scale_ = value.gradient.cwiseAbs().dot(range_);  // not |J|: a constant added to J changes nothing
  if (objective_scale_ == 0) objective_scale_ = std::max(std::abs(value.objective), 1e-300);
  constraint_scale_ = value.constraints.size() > 0 ? Vector(value.jacobian.cwiseAbs() * range_) : Vector();
  for (Eigen::Index j = 0; j < constraints(); ++j)
    if (constraint_scale_[j] == 0) constraint_scale_[j] = std::max(std::abs(value.constraints[j]), 1e-300);
  Vector x = Vector::Zero(variables());
  for (Eigen::Index i = 0; i < variables(); ++i)
    if (is_free(i)) x[i] = (start[i] - problem.lower[i]) / range_[i];
  history_.push_back({1, start, true, value.objective, value.constraints, 0, false, 0, watch_.seconds()});
  const ScaledDesign first = scaled(std::move(x), start, value);
  judge(&first, 0);
}

Vector ScaledProblem::unscaled(const Vector& x) const {
  return (problem_.lower + x.cwiseProduct(range_)).cwiseMax(problem_.lower).cwiseMin(problem_.upper);
}

Evaluation ScaledProblem::checked(const Vector& alpha, Evaluation value) const {
  const Eigen::Index n = alpha.size(), m = value.constraints.size();
  if (value.gradient.size() != n || value.jacobian.rows() != m || (m > 0 && value.jacobian.cols() != n) ||
      (!history_.empty() && m != constraints()))
    throw InputError(text("a design of ", n, " variables has a gradient of ", value.gradient.size(), ", ", m, " constraints and derivatives of ",
                          value.jacobian.rows(), " x ", value.jacobian.cols()));
  if (!std::isfinite(value.objective) || !value.gradient.allFinite() || !value.constraints.allFinite() || !value.jacobian.allFinite())
    throw InputError(text("objective, constraints or derivatives of a design are not numbers (objective ", value.objective, ")"));
  if (m == 0) value.jacobian.resize(0, n);
  return value;
}

ScaledDesign ScaledProblem::scaled(Vector x, Vector alpha, Evaluation given) const {
  ScaledDesign d;
  d.x = std::move(x);
  d.value.objective = given.objective / objective_scale_;
  d.value.gradient = given.gradient.cwiseProduct(range_) / objective_scale_;
  d.value.constraints = given.constraints.cwiseQuotient(constraint_scale_);
  d.value.jacobian = constraint_scale_.cwiseInverse().asDiagonal() * given.jacobian * range_.asDiagonal();
  d.violation = d.value.constraints.cwiseMax(0.0).sum();
  d.alpha = std::move(alpha);
  d.given = std::move(given);
  return d;
}

std::optional<ScaledDesign> ScaledProblem::evaluate(const Vector& x) {
  DesignRecord record{.design = static_cast<int>(history_.size()) + 1, .alpha = unscaled(x), .constraints = {}};
  std::optional<Evaluation> given;
  try {
    given = problem_.evaluate(record.alpha);
  } catch (const Interrupted&) {
    interrupted_ = true;
    return std::nullopt;
  }
  std::optional<ScaledDesign> design;
  if (given) {
    design = scaled(x, record.alpha, checked(record.alpha, *given));
    record.admissible = true;
    record.objective = given->objective;
    record.constraints = given->constraints;
  }
  record.seconds = watch_.seconds();
  history_.push_back(std::move(record));
  return design;
}

void ScaledProblem::judge(const ScaledDesign* better, double radius) {
  if (better) best_ = *better, at_ = stationarity(best_);
  DesignRecord& r = history_.back();
  r.accepted = better != nullptr;
  r.radius = radius;
  r.gap = at_.gap;
  try {
    if (problem_.each) problem_.each(r);
  } catch (const Interrupted&) {
    interrupted_ = true;
  }
}

void ScaledProblem::end(bool converged, std::string reason) {
  converged_ = converged;
  reason_ = std::move(reason);
}

bool ScaledProblem::must_end() {
  if (ended()) return true;
  if (feasible(best_) && at_.gap <= stopping_.tol_gap) end(true, "the first order promises no more");
  else if (interrupted_ || monitor_.stop()) end(false, "stopped");
  else if (static_cast<int>(history_.size()) >= stopping_.max_designs) end(false, text("no more than ", stopping_.max_designs, " designs were allowed"));
  return ended();
}

Optimum ScaledProblem::finish(double radius) {
  Optimum o;
  o.alpha = best_.alpha;
  o.value = best_.given;
  o.multipliers = at_.multipliers.cwiseQuotient(constraint_scale_) * objective_scale_;
  o.gap = at_.gap;
  o.radius = radius;
  const bool stuck = converged_ && at_.gap > std::max(kStuck, stopping_.tol_gap);
  o.converged = converged_ && !stuck && feasible(best_);
  o.reason = reason_;
  if (stuck) o.reason += text("; but over the whole box the first order still promises ", at_.gap, " of what it did at first: the steps are too short, as at kinks");
  if (!feasible(best_)) o.reason += text("; constraints are violated (", best_.violation, " of their changes over the box)");
  o.history = std::move(history_);
  return o;
}

}  // namespace dotyk::shape
