#include "solver/rows/coulomb_loop.hpp"

#include "solver/rows/projection.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;

/// Steps of the loop without a fall of the residual.
constexpr int kLoopPatience = 50;
/// Changes of the bounds below this part of them are the inner solver's rounding, and tell no contraction.
constexpr double kNoise = 1e-8;

/// Gives the rows these bounds, one a point.
void freeze(Problem& rows, const Vector& bounds) {
  Eigen::Index point = 0;
  for (FrictionGroup& group : rows.friction) {
    std::vector<double> own(bounds.data() + point, bounds.data() + point + group.points());
    point += group.points();
    group.law = problem::tresca(std::move(own));
  }
}

/// The geometric mean of the last half of the factors from change to change; 0 where there are too few.
double contraction(const std::vector<double>& changes) {
  if (changes.size() < 3) return 0;
  const std::size_t middle = changes.size() / 2;
  return std::pow(changes.back() / changes[middle], 1.0 / static_cast<double>(changes.size() - 1 - middle));
}

}  // namespace

void CoulombLoop::iterate(RowIteration& it) const {
  Problem rows = laws_of(it.problem);
  InnerMonitor monitor(it.monitor());
  Settings settings = *inner;
  settings.tol = std::min(inner->tol, tol / 10);
  Vector bounds = it.begun() ? friction_bounds(it.problem, it.lambda()) : no_slip_bounds(it.problem);
  std::vector<double> changes;
  int inner_iterations = 0;
  while (it.next()) {
    freeze(rows, bounds);
    RowIteration given(rows, it, settings, inner->map_weight(), monitor);
    if (it.iterations() > 1 || it.begun()) given.begin_at(it.at());
    inner->iterate(given);
    const Result solved = given.finish();
    inner_iterations += solved.iterations;
    it.move_to(given.at());
    const Vector next = friction_bounds(it.problem, it.lambda());
    double factor = 0;
    if (const double change = (next - bounds).norm(); change < kNoSlip && change > kNoise * next.norm()) {
      if (!changes.empty()) factor = change / changes.back();
      changes.push_back(change);
    }
    bounds = next;
    if (it.record({.contraction = factor})) break;
    if (!solved.converged) {
      it.give_up(text("given friction of step ", it.iterations(), " by ", inner->name(), ": ", solved.reason));
      break;
    }
    if (it.stalled(kLoopPatience)) break;
  }
  it.remark(text(inner_iterations, " iterations of ", inner->name(), " in all"));
  if (const double mean = contraction(changes); mean > 0)
    it.remark(text("the bounds' change is multiplied by ", mean, " a step"));
}

}  // namespace dotyk::solver
