#include "solver/active/pdas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "solver/active/nested_start.hpp"
#include "solver/active/rescues.hpp"
#include "solver/core/treatable.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using End = SetIteration::End;

/// Newton steps before rescues are asked, and to confirm what one found.
constexpr int kPatience = 14, kConfirmations = 8;

constexpr std::array<Rescue, 3> kRescues{by_sweeps, by_barrier, by_interior_point};

/// Where the iteration begins if no start is given: where rows follow one another along edges, as few of them end; on unknowns, as an interior point method.
std::string begin(SetIteration& it) {
  const bool given = !it.settings.start.empty();
  if (it.settings.reduced && !it.screws && !given) {
    NestedStart nested(it.problem, it.condensed(), it.rho);
    if (!nested.worthwhile()) return "";
    it.l = it.held(nested.run(*it.step), -it.problem.c);
    return text(", begun with ", nested.solves(), " solves on a part of the rows");
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

/// Newton steps; where they do not come to rest, from where the rescues end, one after the other. A rescue begins while steps are left,
/// and has steps of its own to be confirmed.
End iterate_and_rescue(SetIteration& it, bool& inside, std::string& rescued) {
  if (!it.problem.friction.empty()) return it.iterate(it.left(), it.left());
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
  result.converged = end == End::confirmed;
  switch (end) {
    case End::confirmed: result.reason = (it.problem.friction.empty() ? "active set confirmed" : "the residual fell below tol") + rescued; break;
    case End::misplaced: result.reason = text("a screw still pulls after ", it.screws->moves(), " moves"); break;
    case End::interrupted: result.reason = "interrupted; this is the state so far"; break;
    case End::singular:
      result.reason = text("the linear problem of iteration ", result.iterations, " is singular: active rows contradict each other or do not hold a body",
                           inside ? "; tried interior_point" : "");
      break;
    case End::cycle: {
      const std::string why = "active sets repeated at " + it.places();
      result.reason = "active sets repeat at " + it.places();
      if (!by_active_set(it, why)) by_proximal(it, why);
      break;
    }
    case End::exhausted:
      result.reason = it.problem.friction.empty()
                          ? text("no confirmed active set within ", it.settings.max_iterations, " iterations; rows that still change: ", it.places())
                          : text("after ", result.iterations, " iterations forces are off their laws by ", it.l.off, " of their size, and no longer come nearer");
  }
}

/// Where one-sided rows are closed and bear nothing (below `noise`), for the sake of rigid motions that nothing else holds, the bodies
/// may have gone far for it, and rounding of the way costs digits of the stresses. The same linearisation with such rows held where
/// they are at rest, x_r = −c_r; nothing where there are none, or none of them is apart at rest.
std::optional<Linearisation> held_at_rest(const problem::Problem& problem, const Linearisation& closed, const Vector& lambda,
                                          const Vector& rho, const Noise& noise) {
  std::optional<Linearisation> rest;
  for (const problem::RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      if (!closed.active[r] || std::abs(lambda[r]) > noise.force[r] || !(problem.c[r] > noise.gap[r])) continue;
      if (!rest) rest = closed;
      rest->y[r] = rest->value[r] - rho[r] * problem.c[r];
    }
  }
  return rest;
}

/// Does (λ, x), the solution of `rest` = held_at_rest(closed), obey the laws? `found`: the linearisation there.
bool obeys(const Linearisation& found, const Linearisation& rest, const Linearisation& closed, const Vector& lambda, const Noise& noise) {
  for (int r = 0; r < static_cast<int>(closed.active.size()); ++r) {
    const bool held = rest.y[r] != closed.y[r];
    if (held ? std::abs(lambda[r]) > noise.force[r] : !found.same_piece(closed, r)) return false;
  }
  return true;
}

/// Bodies that were moved for the sake of rows that bear nothing go back, where the laws allow it.
void come_to_rest(SetIteration& it) {
  const problem::Problem& problem = it.problem;
  const Noise before = it.noise(it.lambda, it.x);
  if (it.lambda.size() == 0) return;
  if (!loaded(problem) && (it.lambda.cwiseAbs() - before.force).maxCoeff() <= 0) {  // there is no scale to rest by
    if ((problem.c + before.gap).minCoeff() >= 0) it.lambda.setZero(), it.x = -problem.c, it.settled = Vector::Zero(problem.unknowns());
    return;
  }
  const auto rest = held_at_rest(problem, it.l, it.lambda, it.rho, before);
  if (!rest) return;
  Vector lambda, x;
  if (it.step->solve(*rest, lambda, x)) {
    const Noise small = it.noise(lambda, x);
    if (obeys(linearise(problem, lambda, x, it.rho, small, &it.l), *rest, it.l, lambda, small)) {
      it.lambda = std::move(lambda);
      it.x = std::move(x);
      for (int r = 0; r < problem.rows(); ++r)
        if (rest->y[r] != it.l.y[r]) it.lambda[r] = 0, it.result.active_sets.back()[r] = 0;
      return;
    }
  }
  if (!it.step->solve(it.l, it.lambda, it.x)) throw std::logic_error("pdas: a linear problem that had a solution has none");
}

}  // namespace

Result solve(const problem::Problem& problem, const Pdas& settings, Monitor& monitor) {
  if (settings.reduced || settings.step) require_frictionless(problem, "pdas");
  require_springs(problem, "pdas");
  SetIteration it(problem, settings, monitor);
  Stopwatch iterating;
  const std::string begun = begin(it);
  bool inside = settings.interior && settings.start.empty();  // an interior point method has been tried
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
  if (it.is_analysed()) it.result.factor_bytes = std::max(it.result.factor_bytes, it.stiffness().solver().bytes());
  if (it.result.converged && pieces) confirm_laws(it);
  it.result.clock.recover += iterating.lap();
  return std::move(it.result);
}

}  // namespace dotyk::solver
