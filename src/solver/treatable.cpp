#include "solver/treatable.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

void require_frictionless(const problem::Problem& problem, const std::string& method) {
  if (problem.friction.empty()) return;
  const problem::FrictionGroup& group = problem.friction.front();
  throw InputError(text(method, " cannot treat the ", group.law->name(), " of the ", group.name, "; ", kFrictionMethods, " can"));
}

void require_unilateral_or_linear(const problem::Problem& problem, const std::string& method) {
  require_frictionless(problem, method);
  for (const problem::RowGroup& group : problem.groups)
    if (group.count > 0 && !group.law->unilateral() && !group.law->linear_stiffness(0))
      throw InputError(text(method, " cannot treat the ", group.law->name(), " law of the ", group.name, "; pdas can"));
}

}  // namespace dotyk::solver
