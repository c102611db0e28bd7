#include "solver/active/set_iteration.hpp"

#include <numeric>

#include "base/text.hpp"
#include "solver/active/box_barrier.hpp"
#include "solver/active/descent.hpp"
#include "solver/active/interior_start.hpp"
#include "solver/active/refine.hpp"
#include "solver/core/treatable.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/rows/proximal.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;
using End = SetIteration::End;

namespace {

/// Sweeps between two Newton steps of the descent (and two updates of the free bodies' equilibrium), and how often.
constexpr int kSweeps = 3, kSweepRounds = 3;
/// Rows of a dense problem; steps of active_set, a row.
constexpr int kMostDense = 3000, kStepsPerRow = 20;
constexpr double kBarrierTol = 1e-10, kBeginning = 1e-10;

bool dense(const SetIteration& it) { return it.is_condensed() && it.problem.rows() <= kMostDense; }

}  // namespace

std::string by_sweeps(SetIteration& it, End end) {
  const Problem& problem = it.problem;
  if (end != End::cycle || it.settings.linear || (!it.is_condensed() && problem.rows() > kMostDense)) return "";
  DualDescent descent(problem, it.condensed(), it.lambda);
  const auto newton = reduced_step(it.condensed(), it.rho);
  for (int round = 0; round < kSweepRounds && !it.monitor.stop(); ++round) {
    for (int k = 0; k < kSweeps; ++k) descent.sweep();
    descent.update_equilibrium();
    it.l = linearise(problem, descent.lambda(), descent.jump(), it.rho);
    Vector lambda, x;
    if (!newton->solve(it.l, lambda, x)) continue;
    const Linearisation next = linearise(problem, lambda, x, it.rho, &it.l, it.rounding(lambda, x));
    if (it.l.changed(next).empty()) return "sweeps that decrease the dual energy";
    descent.take_if_lower(lambda);
  }
  it.lambda = descent.lambda();
  it.x = descent.jump();
  it.alpha = descent.alpha();
  return "";
}

std::string by_barrier(SetIteration& it, End) {
  if (!dense(it)) return "";
  it.monitor.phase("the active sets do not come to rest: a barrier method on the rows");
  std::vector<int> rows(it.problem.rows());
  std::iota(rows.begin(), rows.end(), 0);
  const BoxSolution s = solve_by_barrier(box_program(it.problem, it.condensed(), it.measure, rows, std::vector<double>(rows.size(), 1)), kBarrierTol);
  if (!s.converged) return "";
  Vector jump = it.condensed().jump(s.lambda, s.alpha);
  for (int r = 0; r < jump.size(); ++r)
    if (s.side[r] == 0) jump[r] = 0;  // the barrier's error, which ρ can blow up until it leaves the bounds
  it.go_on_from(s.lambda, jump);
  return text(s.iterations, " steps of a barrier method");
}

std::string by_interior_point(SetIteration& it, End) {
  it.monitor.phase("an interior point method");
  const InteriorPointState s = interior_start(it.problem, it.stiffness(), kBeginning, it.monitor);
  if (s.iterations == 0) return "";
  it.go_on_from(s.lambda, s.x);
  return text(s.iterations, " steps of an interior point method");
}

bool by_active_set(SetIteration& it, const std::string& why) {
  if (!unilateral_or_linear(it.problem) || it.problem.rows() > kMostDense) return false;
  ActiveSet method;
  method.tol = it.settings.tol;
  method.ordering = it.settings.ordering;
  method.max_iterations = kStepsPerRow * it.problem.rows();
  it.monitor.phase(why + ": the active-set method of programs, from rest");
  InnerMonitor monitor(it.monitor);
  Result settled = solve(it.problem, method, monitor);
  Result& result = it.result;
  if (!settled.converged) {  // the state that was there is no worse
    result.reason += text("; ", settled.iterations, " steps of active_set in vain: ", settled.reason);
    return false;
  }
  result.converged = true;
  result.working_set = settled.working_set;
  result.active_sets.push_back(settled.active_sets.back());
  result.clock.factor += settled.clock.factor;
  result.reason = text("active set confirmed; before, ", why, ", left by ", settled.iterations, " steps of active_set");
  it.lambda = settled.state.lambda;
  it.settled = std::move(settled.state.u);
  return true;
}

bool by_proximal(SetIteration& it, const std::string& why) {
  if (!dense(it)) return false;
  Proximal method;
  method.tol = it.settings.tol;
  it.monitor.phase(why + ": the proximal point method");
  InnerMonitor monitor(it.monitor);
  Result settled = solve(it.problem, it.condensed(), method, monitor);
  Result& result = it.result;
  if (!settled.converged) {
    result.reason += text("; ", settled.iterations, " iterations of proximal in vain: ", settled.reason);
    return false;
  }
  result.converged = true;
  result.active_sets.push_back(settled.active_sets.back());
  result.reason = text(settled.reason, "; before, ", why, ", left by ", settled.iterations, " iterations of proximal");
  it.lambda = settled.state.lambda;
  it.settled = std::move(settled.state.u);
  return true;
}

void confirm_laws(SetIteration& it) {
  Result& result = it.result;
  if (!it.is_condensed() && problem::distance_from_laws(it.problem, result.state) <= result.noise) return;
  problem::Residual r = problem::residual(it.problem, result.state);
  if (it.is_condensed() && std::max(r.laws(), r.equilibrium) > kRounded) refine(it.problem, it.condensed(), result, r);
  const double laws = r.laws();
  if (!(laws > result.noise)) return;
  if (it.is_condensed() && go_on_on_all_unknowns(it.problem, it.settings, result, it.monitor)) return;
  if (by_proximal(it, text("rounding put the state off its laws by ", laws))) result.state = {*it.settled, it.lambda};
}

}  // namespace dotyk::solver
