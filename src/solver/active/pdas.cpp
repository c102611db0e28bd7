#include "solver/active/pdas.hpp"

#include "solver/active/coarse_start.hpp"
#include "solver/active/nested_start.hpp"
#include "solver/active/set_iteration.hpp"
#include "solver/core/treatable.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using End = SetIteration::End;

/// Newton steps before rescues are asked, and to confirm what one found.
constexpr int kPatience = 14, kConfirmations = 8;

constexpr std::array<Rescue, 3> kRescues{by_sweeps, by_barrier, by_interior_point};

/// Where neither rows nor a state are given: condensed, begins at a solution on a part of the rows (nested_start); on all unknowns, if
/// settings.interior, where an interior point method ends. Returns what it did, for the reason.
std::string begin(SetIteration& it) {
  const bool given = it.begins_somewhere();
  if (it.settings.reduced && !it.screws && !given) {
    const auto nested = nested_start(it.problem, it.condensed(), it.measure, it.rho, *it.step);
    if (!nested) return "";
    it.l = it.held(nested->linearisation, -it.problem.c);
    return text(", begun with ", nested->solves, " solves on a part of the rows");
  }
  if (!it.settings.interior || given || !it.problem.friction.empty()) return "";
  const std::string how = by_interior_point(it, End::exhausted);
  return how.empty() ? "" : ", begun with " + how;
}

bool comes_to_no_rest(End end) { return end == End::cycle || end == End::singular || end == End::exhausted; }

/// What made Newton steps end, as a rescue's reason begins.
std::string cause(const SetIteration& it, End end) {
  if (end == End::cycle) return "active sets repeated at " + it.places();
  if (end == End::singular) return text("the linear problem of iteration ", it.result.iterations, " was singular");
  return text("no confirmed active set in ", it.result.iterations, " iterations");
}

/// Newton steps; where they do not come to rest, and no unknowns are hidden, from where the rescues end, one after the other. A rescue begins while steps are left,
/// and has steps of its own to be confirmed.
End iterate_and_rescue(SetIteration& it, bool& inside, std::string& rescued) {
  if (!it.problem.friction.empty() || it.settings.rough || it.problem.hides()) return it.iterate(it.left(), it.left());
  End end = it.iterate(it.left(), kPatience);
  for (const Rescue rescue : kRescues) {
    if (it.left() <= 0 || !comes_to_no_rest(end)) break;
    if (rescue == by_interior_point && std::exchange(inside, true)) continue;
    const std::string why = cause(it, end), how = rescue(it, end);
    if (how.empty()) continue;
    rescued = "; before, " + why + ", left by " + how;
    end = it.iterate(kConfirmations, kConfirmations);
  }
  return end == End::exhausted && it.left() > 0 ? it.iterate(it.left(), it.left()) : end;
}

void conclude(SetIteration& it, End end, bool inside, const std::string& rescued) {
  Result& result = it.result;
  result.converged = end == End::confirmed || (end == End::cycle && it.settings.rough);
  switch (end) {
    case End::confirmed: result.reason = (it.problem.friction.empty() ? "active set confirmed" : "the residual fell below tol") + rescued; break;
    case End::misplaced: result.reason = text("a screw still pulls after ", it.screws->moves(), " moves"); break;
    case End::interrupted: result.reason = "interrupted; this is the state so far"; break;
    case End::singular:
    case End::cycle: {
      const std::string why = cause(it, end);
      result.reason = end == End::cycle ? "active sets repeat at " + it.places()
                                        : text("the linear problem of iteration ", result.iterations, " is singular: active rows contradict each other or do not hold a body",
                                               inside ? "; tried interior_point" : "");
      if (!it.settings.rough && !it.problem.hides() && it.problem.friction.empty() && !by_active_set(it, why)) by_proximal(it, why);
      break;
    }
    case End::exhausted:
      result.reason = it.problem.friction.empty()
                          ? text("no confirmed active set within ", it.settings.max_iterations, " iterations; rows that still change: ", it.places())
                          : text("after ", result.iterations, " iterations forces are off their laws by ", it.l.off, " of their size, and no longer come nearer");
  }
}

/// Where one-sided rows are closed and bear nothing, for the sake of rigid motions that nothing else holds, the bodies may have gone far for
/// it, and rounding of the way costs digits of the stresses. Such rows are held where they are at rest, x_r = −c_r, where the laws allow it.
void come_to_rest(SetIteration& it) {
  const problem::Problem& problem = it.problem;
  const problem::Nothing before = it.rounding(it.lambda, it.x);
  if (it.lambda.size() == 0) return;
  if (!problem.loaded() && (it.lambda.cwiseAbs() - before.force).maxCoeff() <= 0) {  // there is no scale to rest by
    if ((problem.c + before.gap).minCoeff() >= 0) it.lambda.setZero(), it.x = -problem.c, it.settled = problem.hides() ? problem::Displacement(algebra::Field(problem::vectors(problem))) : Vector::Zero(problem.unknowns());
    return;
  }
  Linearisation rest = it.l;
  std::vector<int> resting;
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    if (!law.unilateral() || !it.l.active[r] || std::abs(it.lambda[r]) > before.force[r] || !(problem.c[r] > before.gap[r])) continue;
    rest.y[r] = rest.value[r] - it.rho[r] * problem.c[r];
    resting.push_back(r);
  }
  if (resting.empty()) return;
  Vector lambda, x;
  if (it.step->solve(rest, lambda, x)) {
    while (it.step->sharpen(lambda, x)) {}
    const problem::Nothing small = it.rounding(lambda, x);
    Linearisation found = linearise(problem, lambda, x, it.rho, &it.l, small);
    bool allowed = true;
    for (const int r : resting) {
      allowed = allowed && std::abs(lambda[r]) <= small.force[r];
      found.set(r, it.l.y[r], {it.l.value[r], it.l.slope[r]});  // wherever it is
    }
    if (allowed && found.changed(it.l).empty()) {
      it.lambda = std::move(lambda), it.x = std::move(x);
      for (const int r : resting) it.lambda[r] = 0, it.result.active_sets.back()[r] = 0;
      return;
    }
  }
  if (!it.step->solve(it.l, it.lambda, it.x)) throw std::logic_error("pdas: a linear problem that had a solution has none");
  while (it.step->sharpen(it.lambda, it.x)) {}
}

/// From the solution on coarser meshes.
Result solve_nested(const problem::Problem& problem, Pdas settings, Monitor& monitor) {
  Stopwatch watch;
  const CoarseStart coarse = coarse_start(problem, settings, monitor);
  settings.from = coarse.state, settings.stiffness = coarse.stiffness, settings.nested = false;
  const double before = watch.lap();
  Result result = solve(problem, settings, monitor);
  result.clock.ordering += coarse.ordering, result.clock.iterate += before - coarse.ordering;
  if (coarse.meshes > 0) result.reason += text(", begun on ", coarse.meshes, coarse.meshes == 1 ? " coarser mesh" : " coarser meshes");
  return result;
}

}  // namespace

Result solve(const problem::Problem& problem, const Pdas& settings, Monitor& monitor) {
  if (settings.reduced || settings.step) require_frictionless(problem, "pdas");
  require_springs(problem, settings.reduced ? "pdas" : "pdas on all unknowns, which multigrid uses,");
  if (settings.nested && settings.start.empty() && !settings.from) return solve_nested(problem, settings, monitor);
  SetIteration it(problem, settings, monitor);
  Stopwatch iterating;
  const std::string begun = begin(it);
  bool inside = settings.interior && !it.begins_somewhere();  // an interior point method has been tried
  std::string rescued;
  const End end = iterate_and_rescue(it, inside, rescued);
  conclude(it, end, inside, rescued);
  const bool pieces = problem.friction.empty() && !it.screws;  // that tell the state
  if (end == End::confirmed && pieces) come_to_rest(it);
  it.result.reason += begun;
  if (!it.solvable.note.empty()) it.result.reason += "; " + it.solvable.note;
  it.result.clock.iterate += iterating.lap();
  monitor.phase("recovering the displacement");
  it.result.state = it.state();
  if (it.is_analysed()) {
    const algebra::SpdSolver& solver = it.stiffness().solver();
    it.result.factor_bytes = std::max(it.result.factor_bytes, solver.bytes());
    if (solver.levels() > 0) it.result.method = "multigrid", it.result.multigrid = {solver.levels(), it.linear_iterations(), it.result.iterations};
  }
  if (it.result.converged && pieces && !settings.rough) confirm_laws(it);
  it.result.clock.recover += iterating.lap();
  return std::move(it.result);
}

}  // namespace dotyk::solver
