#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "shape/optimise/linear_program.hpp"
#include "shape/optimise/scaled_problem.hpp"

namespace dotyk::shape {
namespace {

constexpr double kTaken = 1e-3, kPoor = 0.25, kGood = 0.75;  ///< actual by predicted reduction
constexpr double kShare = 0.1;        ///< of the possible improvement of constraints that a step must bring
constexpr double kRounding = 1e-14;   ///< of violations and predictions in scaled terms
constexpr double kGreatest = 1e12;    ///< of ν

struct Step {
  Vector d;
  double violation = 0;  ///< linearised, Σ t_j
  double predicted = 0;  ///< reduction of the merit
  std::string failure;   ///< of the simplex method; empty: none
};

class Stepper {
 public:
  Stepper(const ScaledProblem& problem, double penalty) : problem_(problem), penalty_(penalty) {}

  double penalty() const { return penalty_; }
  double merit(const ScaledDesign& at) const { return at.value.objective + penalty_ * at.violation; }

  Step step(const ScaledDesign& at, double radius) {
    Step found = elastic(at, radius, 1, penalty_);
    if (!found.failure.empty() || found.violation <= kRounding) return found;
    const Step feasible = elastic(at, radius, 0, 1);
    if (!feasible.failure.empty()) return feasible;
    const double possible = at.violation - feasible.violation;
    const auto enough = [&] {
      const bool kept = feasible.violation <= kRounding ? found.violation <= kRounding : at.violation - found.violation >= kShare * possible;
      return kept && found.predicted >= kShare * penalty_ * possible;
    };
    while (possible > kRounding && !enough() && penalty_ < kGreatest) {
      penalty_ *= 10;
      found = elastic(at, radius, 1, penalty_);
      if (!found.failure.empty()) return found;
    }
    return found;
  }

 private:
  /// min w g·d + ν Σ t.
  Step elastic(const ScaledDesign& at, double radius, double w, double nu) const {
    const Eigen::Index n = problem_.variables(), m = problem_.constraints();
    LinearProgram lp;
    lp.g = Vector::Constant(n + m, nu);
    lp.g.head(n) = w * at.value.gradient;
    lp.A.resize(m, n + m);
    lp.A.leftCols(n) = at.value.jacobian;
    lp.A.rightCols(m) = -DenseMatrix::Identity(m, m);
    lp.b = -at.value.constraints;
    lp.lower = Vector::Zero(n + m);
    lp.upper = Vector::Constant(n + m, INFINITY);
    for (Eigen::Index i = 0; i < n; ++i) {
      lp.lower[i] = problem_.is_free(i) ? std::max(-radius, -at.x[i]) : 0;
      lp.upper[i] = problem_.is_free(i) ? std::min(radius, 1 - at.x[i]) : 0;
    }
    const LinearSolution s = minimise(lp);
    if (s.status != LinearStatus::solved) return {{}, 0, 0, s.reason};
    Step step{s.d.head(n), s.d.tail(m).sum(), 0, {}};
    step.predicted = -at.value.gradient.dot(step.d) + nu * (at.violation - step.violation);
    return step;
  }

  const ScaledProblem& problem_;
  double penalty_;
};

/// A step, the next box's radius, and whether the search has ended.
void advance(ScaledProblem& problem, Stepper& stepper, double& radius) {
  const Step step = stepper.step(problem.best(), radius);
  if (!step.failure.empty()) return problem.end(false, "no step: " + step.failure);
  if (step.predicted <= kRounding) return problem.end(true, "the first order promises no more");
  const double length = step.d.lpNorm<Eigen::Infinity>(), sought = radius;
  const auto trial = problem.evaluate(problem.best().x + step.d);
  if (problem.interrupted()) return;
  const double ratio = trial ? (stepper.merit(problem.best()) - stepper.merit(*trial)) / step.predicted : -INFINITY;
  if (ratio < kPoor) radius = length / 2;
  else if (ratio > kGood && length > 0.99 * radius) radius = std::min(1.0, 2 * radius);
  const bool taken = ratio >= kTaken;
  problem.judge(taken ? &*trial : nullptr, sought);
  const double tol = problem.stopping().tol_design;
  if (taken ? length < tol : radius < tol)
    problem.end(trial.has_value(), trial ? "the design changes by less than tol_design" : "designs farther on are not admissible");
}

}  // namespace

Optimum minimise(const DesignProblem& problem, const Vector& start, const Slp& settings, Monitor& monitor) {
  if (!(settings.radius > 0) || !(settings.penalty > 0))
    throw InputError(text("the first radius (", settings.radius, ") and penalty (", settings.penalty, ") must be positive"));
  ScaledProblem scaled(problem, start, settings, monitor);
  Stepper stepper(scaled, settings.penalty);
  double radius = settings.radius;
  while (!scaled.must_end()) advance(scaled, stepper, radius);
  return scaled.finish(radius);
}

}  // namespace dotyk::shape
