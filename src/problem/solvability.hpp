#pragma once

#include "problem/problem.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::problem {

/// Does the problem have a solution? The load against the cone of admissible rigid motions
/// (TR965 (1.70)–(1.71)): a solution exists exactly if the load does no positive work on any of
/// them, that is (Farkas) if multipliers that the laws can carry balance it, Nᵀλ = e.
struct Solvability {
  enum class Verdict {
    unique,        ///< solvable; the load works against every admissible motion
    up_to_motion,  ///< solvable; `motion` changes nothing (the stress is unique)
    unsolvable,    ///< the load does positive work on the admissible motion `motion`
    unknown,       ///< nothing is proved: the iteration ended before it was known whether the load is carried, or is a limit case
  };
  Verdict verdict = Verdict::unique;
  /// On the edge: solvable, but turned by 1e-6 the load is not; or the other way round. Never of parts without a load.
  bool limit = false;
  bool carried = true;     ///< proved: the load is balanced by multipliers that the laws can carry
  algebra::Vector motion;  ///< amounts of the modes, greatest 1; empty for unique and unknown
  double work = 0;         ///< of the load on `motion`
};
Solvability solvability(const RigidMotions& rigid, const Problem& problem);

}  // namespace dotyk::problem
