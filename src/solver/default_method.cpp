#include "solver/default_method.hpp"

#include <algorithm>

#include "solver/newton.hpp"
#include "solver/pdas.hpp"

namespace dotyk::solver {

DefaultMethod default_method(const problem::Problem& problem) {
  if (problem.rows() == 0) return DefaultMethod::linear;
  if (!problem.friction.empty() || !tells_springs(problem)) return DefaultMethod::newton;
  constexpr int kMany = 3000, kShare = 10;
  return problem.rows() > kMany && kShare * problem.rows() > problem.unknowns() ? DefaultMethod::sparse_pdas : DefaultMethod::pdas;
}

Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor) {
  const DefaultMethod by_default = default_method(problem);
  if (by_default == DefaultMethod::linear && !method.decomposition()) return solve_linear(problem, method.ordering(), monitor);
  if (method) return method.run(problem, std::move(from), monitor);
  if (by_default == DefaultMethod::newton) return Method(Newton{}).run(problem, std::move(from), monitor);
  Pdas pdas;
  pdas.reduced = by_default == DefaultMethod::pdas;
  return Method(pdas).run(problem, std::move(from), monitor);
}

}  // namespace dotyk::solver
