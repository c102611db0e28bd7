#include "solver/core/default_method.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "solver/core/near_rows.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"

namespace dotyk::solver {

DefaultMethod default_method(const problem::Problem& problem) {
  if (problem.rows() == 0) return DefaultMethod::linear;
  if (!problem.friction.empty() || !tells_springs(problem)) return DefaultMethod::newton;
  constexpr int kMany = 3000, kShare = 10;
  return problem.rows() > kMany && kShare * problem.rows() > problem.unknowns() ? DefaultMethod::sparse_pdas : DefaultMethod::pdas;
}

namespace {

/// By newton or pdas; `by_default` as default_method() says.
Result run(const problem::Problem& problem, DefaultMethod by_default, Beginning from, Monitor& monitor, std::optional<bool> condensed = {}) {
  if (by_default == DefaultMethod::newton) return Method(Newton{}).run(problem, std::move(from), monitor);
  Pdas pdas;
  pdas.reduced = condensed.value_or(by_default == DefaultMethod::pdas);
  pdas.held = !pdas.reduced && condensed;
  return Method(pdas).run(problem, std::move(from), monitor);
}

/// On the rows that may close; nothing where they do not hold the bodies.
std::optional<Result> run_near(NearRows near, Beginning from, Monitor& monitor) {
  problem::Clock before;
  for (;;) try {
      const problem::Problem part = near.restricted();
      Result result = run(part, default_method(part), {near.restricted(from.start), nullptr, from.from ? std::make_shared<problem::State>(near.restricted(*from.from)) : nullptr}, monitor);
      near.extend(result);
      result.clock.add_solve(before);
      if (!result.converged || !near.join(result.state.u)) return result;
      before = result.clock;
      from = {result.active_sets.back(), nullptr, nullptr};
    } catch (const InputError&) {
      return std::nullopt;
    }
}

}  // namespace

Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor, std::optional<bool> condensed) {
  const DefaultMethod by_default = default_method(problem);
  if (by_default == DefaultMethod::linear && !method.decomposition()) return solve_linear(problem, method.ordering(), monitor);
  if (method) return method.run(problem, std::move(from), monitor);
  if (!from.condenser && !condensed) {
    NearRows near(problem, from.start);
    if (!near.all())
      if (auto result = run_near(std::move(near), from, monitor)) return *std::move(result);
  }
  return run(problem, by_default, std::move(from), monitor, condensed);
}

}  // namespace dotyk::solver
