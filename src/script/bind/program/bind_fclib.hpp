#pragma once
// Frictional contact problems from files, as scripts hold them.
#include "fclib/solve.hpp"
#include "script/bridge/call.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {

template <> struct Wrapped<fclib::ContactProblem> : Called<"contact_problem"> {};

// A result remembers its problem.
struct ContactProblemResult {
  std::shared_ptr<fclib::ContactProblem> problem;
  fclib::Result result;
  double seconds = 0;
};
template <> struct Wrapped<ContactProblemResult> : Called<"contact_problem_result"> {};

// Solves by the method, gives the result and answers Ctrl-C.
std::shared_ptr<ContactProblemResult> solve_contact_problem(Call& call, const std::shared_ptr<fclib::ContactProblem>& problem,
                                                            const Solver& solver, std::vector<Function> on_iteration);

}  // namespace dotyk::script
