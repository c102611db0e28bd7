#include "solver/core/treatable.hpp"

namespace dotyk::solver {

void require_frictionless(const problem::Problem& problem, const std::string& method) {
  if (problem.friction.empty()) return;
  const problem::FrictionGroup& group = problem.friction.front();
  throw InputError(text(method, " cannot treat the ", group.law->name(), " of the ", group.name, "; ", kFrictionMethods, " can"));
}

namespace {

bool tells_no_springs(const problem::RowGroup& group) { return group.count > 0 && !group.law->springs(0); }

bool is_other(const problem::RowGroup& group) {
  return group.count > 0 && !group.law->unilateral() && !group.law->linear_stiffness(0);
}

}  // namespace

bool tells_springs(const problem::Problem& problem) {
  return std::none_of(problem.groups.begin(), problem.groups.end(), tells_no_springs);
}

void require_springs(const problem::Problem& problem, const std::string& method) {
  const auto found = std::find_if(problem.groups.begin(), problem.groups.end(), tells_no_springs);
  if (found != problem.groups.end())
    throw InputError(text(method, " cannot treat the ", found->law->name(), " law of the ", found->name,
                          ", which does not tell its springs; newton, proximal, uzawa, uzawa_pdas, psor and coulomb_loop can"));
}

bool all_linear(const problem::Problem& problem) {
  return problem.friction.empty() && std::all_of(problem.groups.begin(), problem.groups.end(), [](const problem::RowGroup& group) {
    for (int k = 0; k < group.count; ++k)
      if (!group.law->linear_stiffness(k)) return false;
    return true;
  });
}

bool unilateral_or_linear(const problem::Problem& problem) {
  return problem.friction.empty() && std::none_of(problem.groups.begin(), problem.groups.end(), is_other);
}

void require_unilateral_or_linear(const problem::Problem& problem, const std::string& method) {
  require_frictionless(problem, method);
  const auto other = std::find_if(problem.groups.begin(), problem.groups.end(), is_other);
  if (other != problem.groups.end())
    throw InputError(text(method, " cannot treat the ", other->law->name(), " law of the ", other->name, other->law->springs(0) ? "; pdas can" : "; newton can"));
}

}  // namespace dotyk::solver
