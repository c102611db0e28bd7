#pragma once

#include <string>

#include "base/error.hpp"
#include "base/monitor.hpp"
#include "problem/condensed.hpp"
#include "problem/solvability.hpp"
#include "solver/core/friction_bound.hpp"

namespace dotyk::solver {

/// Nothing holds a body, or no forces that its rows can carry balance the load.
struct NotHeld : InputError {
  using InputError::InputError;
};

/// Throws NotHeld where the problem has no solution, naming the motion, the work that the load
/// does on it and what would hold it. Otherwise returns what is to be known of the solution.
struct KnownBefore {
  std::string note;  ///< up to which motion it is unique, that the load is a limit case, or that this is not known; empty where it is unique
  bool exists;       ///< proved: the load is carried (by rigid bodies, where friction is Coulomb's)
};
KnownBefore require_solvable(const problem::Problem& problem, const problem::RigidMotions& rigid);

/// The rigid motions of a problem that has a solution, and what require_solvable() says of that. Adds the time to `clock`; throws
/// Interrupted where the monitor asks to stop.
struct Solvable {
  problem::RigidMotions rigid;
  std::string note;
};
Solvable require_solvable(const problem::Problem& problem, problem::Clock& clock, Monitor& monitor);

/// Refuses a load that only friction could stop, after a proof that no attainable pressure gives enough friction: throws NotHeld, naming the
/// motion. `proof`: how it was proved, one phrase.
[[noreturn]] void refuse_unbearable(const FrictionalMotion& motion, const std::string& proof);

/// Refuses where friction_is_too_weak(): for a method that has failed.
void require_bearable(const problem::Problem& problem, const problem::CondensedProblem& condensed, Monitor& monitor);

/// Of the resultants of loads that nothing balances, one for each mode of the blocks' kernels, which is the greatest and
/// what would hold it: ", most of all 'lid': translation along x, with 3.5. Hold …"; empty where modes have no names.
std::string unbalanced_motion(const problem::Problem& problem, const algebra::Vector& resultants);

}  // namespace dotyk::solver
