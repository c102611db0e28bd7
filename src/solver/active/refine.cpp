#include "solver/active/refine.hpp"

#include "problem/measure.hpp"
#include "solver/active/pdas.hpp"
#include "solver/core/treatable.hpp"
#include "solver/rows/natural_map.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;
using problem::State;

/// f − Ku − Bᵀλ.
Vector out_of_balance(const Problem& problem, const State& state) {
  Vector left = -(problem::stiffness_times(problem, state.u) + problem.B.transpose() * state.lambda);
  for (const problem::Block& block : problem.blocks) left.segment(block.first, block.size()) += block.f;
  return left;
}

namespace {

/// The natural map about a state: at λ of the state and α = 0 it is that of the state's own displacements.
struct About {
  About(const Problem& problem, const CondensedProblem& condensed, const State& state)
      : at{state.lambda, Vector::Zero(condensed.kernel_size())}, centred(condensed.centred(problem, at.lambda, at.alpha, state.u.here())),
        map(problem, centred, problem::Measure(problem, condensed).stiffness()) {}
  Iterate at;
  CondensedProblem centred;
  NaturalMap map;
};

/// Newton's step from this state; nothing where it is not finite.
std::optional<State> step(const Problem& problem, const CondensedProblem& condensed, const State& from) {
  const State balanced{from.u.here() + condensed.response(out_of_balance(problem, from), Vector::Zero(condensed.kernel_size())), from.lambda};
  const About about(problem, condensed, balanced);
  const Iterate next = about.map.solve(about.map.linearise(about.map.at(about.at)));
  if (!next.finite()) return std::nullopt;
  State to{balanced.u.here() + condensed.response(problem.B.transpose() * (from.lambda - next.lambda), next.alpha), next.lambda};
  return to.u.here().allFinite() && to.lambda.allFinite() ? std::optional(std::move(to)) : std::nullopt;
}

}  // namespace

bool refine(const Problem& problem, const CondensedProblem& condensed, Result& result, problem::Residual& at) {
  constexpr int kSteps = 3;
  const auto off = [](const problem::Residual& r) { return std::max(r.laws(), r.equilibrium); };
  bool better = false;
  for (int k = 0; k < kSteps; ++k) {
    std::optional<State> next = step(problem, condensed, result.state);
    if (!next) break;
    const double before = off(at);
    const problem::Residual there = problem::residual(problem, *next);
    if (!(off(there) < before)) break;
    result.state = std::move(*next), at = there, better = true;
    if (off(at) > 0.1 * before) break;
  }
  if (!better) return false;
  const About about(problem, condensed, result.state);
  NaturalMap::Value pieces = about.map.at(about.at);
  result.active_sets.push_back(std::move(pieces.closed));
  result.slipping = std::move(pieces.slipping);
  return true;
}

std::optional<Result> on_all_unknowns(const Problem& problem, const Settings& settings, const std::vector<char>& active, double laws, Monitor& monitor) {
  if (!tells_springs(problem) || problem.hides()) return std::nullopt;
  Pdas whole;
  whole.tol = settings.tol, whole.ordering = settings.ordering, whole.reduced = false, whole.start = active;
  InnerMonitor inner(monitor);
  try {
    Result found = solve(problem, whole, inner);
    if (found.converged && problem::residual(problem, found.state).laws() < laws) return found;
  } catch (const InputError&) {  // rows that share their unknowns with others are no task for it
  }
  return std::nullopt;
}

bool go_on_on_all_unknowns(const Problem& problem, const Settings& settings, Result& result, Monitor& monitor) {
  const double laws = problem::residual(problem, result.state).laws();
  std::optional<Result> found = on_all_unknowns(problem, settings, result.active_sets.back(), laws, monitor);
  if (!found) return false;
  result.state = std::move(found->state);
  result.active_sets.push_back(found->active_sets.back());
  result.slipping = std::move(found->slipping);
  result.clock.add_solve(found->clock);
  result.reason += text("; condensed, rounding put the state off its laws by ", laws, ": ", found->iterations, " iterations on all unknowns");
  return true;
}

}  // namespace dotyk::solver
