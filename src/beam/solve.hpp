#pragma once

#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "beam/solution.hpp"
#include "solver/core/method.hpp"

namespace dotyk::beam {

/// A local minimum of the energy, and which of breaking() are broken in it.
struct Branch {
  std::vector<Broken> broken;
  std::shared_ptr<const Solution> solution;
};

/// All solutions of a beam: one, but where supports may break (laws that are not monotone, P4 figures 16 and 17). There
/// every choice of broken and whole supports is a convex problem, and its solution is a local minimum of the energy
/// where no whole support bears more than its limit and every broken one is displaced by more than what breaks it.
/// Least energy first. No method named: PDAS.
///
/// Throws InputError where there is no solution (theorems 2 to 5 of P4), telling the ends, the motion and the condition;
/// where whichever breaking supports are whole, one of them would break; where the method cannot treat a law of one of the
/// choices, so that no branch is missed; with more than twelve supports that may break.
std::vector<Branch> solve(const Beam& beam, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::beam
