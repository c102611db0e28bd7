#include "solver/core/method.hpp"

#include "solver/core/friction_bound.hpp"

namespace dotyk::solver {
namespace {

/// In the order of how far they can be relied on.
std::vector<std::string> methods_for(const problem::Problem& problem) {
  std::vector<std::string> all{"proximal", "newton"};
  const bool springs = tells_springs(problem);
  if (springs && problem.friction.empty()) all.insert(all.begin(), "pdas");
  if (springs) all.push_back("projected_cg");
  all.push_back("psor");
  return all;
}

std::string next_method(const problem::Problem& problem, const Result& failed) {
  for (const std::string& name : methods_for(problem))
    if (!failed.method.starts_with(name) && failed.reason.find("tried " + name) == std::string::npos) return "; a method to try next: " + name;
  return "";
}

/// By the pressures of the state, which is no solution: a hint, no proof.
std::string too_little_friction(const problem::Problem& problem, const Result& failed) {
  constexpr double kEnough = 1.001;
  const auto motion = stopped_by_friction_alone(problem);
  if (!motion) return "";
  const double capacity = friction_capacity(problem, *motion, failed.state.lambda);
  if (!(capacity < kEnough * motion->work)) return "";
  return text("; there may be no solution: only friction stops ", describe(motion->rigid.motions, motion->amounts),
              ", on a unit of which the load does work ", motion->work, ", and friction under the pressures of this state ", capacity, " at most");
}

}  // namespace

Result Method::ended(const problem::Problem& problem, Result result, double tol, Monitor& monitor) {
  result.asked = tol;
  if (!result.converged && !monitor.stop() && problem.rows() > 0) result.reason += too_little_friction(problem, result) + next_method(problem, result);
  return result;
}

Result Method::run(const problem::Problem& problem, const problem::CondensedProblem& condensed, Monitor& monitor) const {
  if (!on_rows_) throw InputError(text("this method works on scenes alone; on rows alone work ", kRowMethods));
  return ended(problem, solve(problem, condensed, *on_rows_, monitor), on_rows_->tol, monitor);
}

}  // namespace dotyk::solver
