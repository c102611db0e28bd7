#include "solver/default_method.hpp"

#include <algorithm>

#include "solver/newton.hpp"
#include "solver/pdas.hpp"

namespace dotyk::solver {

DefaultMethod default_method(const problem::Problem& problem) {
  if (problem.rows() == 0) return DefaultMethod::linear;
  return problem.friction.empty() && tells_springs(problem) ? DefaultMethod::pdas : DefaultMethod::newton;
}

Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor) {
  const DefaultMethod by_default = default_method(problem);
  if (by_default == DefaultMethod::linear && !method.decomposition()) return solve_linear(problem, method.ordering(), monitor);
  if (method) return method.run(problem, std::move(from), monitor);
  return (by_default == DefaultMethod::pdas ? Method(Pdas{}) : Method(Newton{})).run(problem, std::move(from), monitor);
}

}  // namespace dotyk::solver
