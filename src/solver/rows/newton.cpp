#include "solver/rows/newton.hpp"

#include <cmath>
#include <random>

#include "base/text.hpp"
#include "solver/rows/handover.hpp"
#include "solver/rows/newton_stepper.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;

/// Newton's method has lost its way after so many iterations, or rounds of the fixed point iteration in their place: where it
/// converges it takes some ten, and few of these.
constexpr int kNewtonPatience = 40, kMostStuck = 3;

/// Moves to random multipliers and rigid motions, in a box sized by those of the iterate.
void scatter(RowIteration& iteration, unsigned seed) {
  std::mt19937 engine(seed);
  const auto between = [&](double a, double b) { return a + (b - a) * (engine() >> 8) / 16777216.0; };
  Vector v = iteration.map.scaled_lambda(iteration.lambda()), a(iteration.alpha().size());
  const double greatest = v.size() ? v.lpNorm<Eigen::Infinity>() : 0;
  const double size = (greatest > 0 ? greatest : 1) * std::pow(10, between(-1, 2));
  for (double& value : v) value = size * between(-1, 1);
  for (double& value : a) value = size * between(-1, 1);
  iteration.move_to(iteration.map.lambda(v), iteration.map.alpha(a));
}

}  // namespace

void Newton::iterate(RowIteration& iteration) const {
  NewtonStepper stepper(iteration, watch);
  // Everything that touches at rest (or is told to) sticks: one linear problem.
  if (!iteration.begun()) stepper.start(iteration.map.sticking(start));
  if (seed) scatter(iteration, *seed);
  bool astray = false;
  // On the right pieces a step of given friction in the plane is exact; others converge quadratically.
  while (iteration.next()) {
    stepper.step();
    if (iteration.record({.singular_value = stepper.singular_value()})) break;
    astray = iteration.iterations() >= kNewtonPatience || stepper.stuck() >= kMostStuck;
    if (astray) break;
  }
  for (const std::string& remark : stepper.remarks()) iteration.remark(remark);
  if (astray) hand_over(iteration, tol);
}

}  // namespace dotyk::solver
