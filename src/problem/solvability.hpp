#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// The rigid motions of all blocks against the rows: with α the amounts of the kernel's modes,
/// N α is the jump that a motion makes on the rows, and eᵀα the work of the load on it.
struct RigidMotions {
  algebra::DenseMatrix N;          ///< B R, rows × modes
  algebra::Vector e;               ///< Rᵀ f
  std::vector<std::string> names;  ///< "'lid': translation along x", one a mode
  int count() const { return static_cast<int>(e.size()); }
};
RigidMotions rigid_motions(const Problem& problem);

/// "'lid': translation along x", or a combination with its amounts.
std::string describe(const RigidMotions& rigid, const algebra::Vector& motion);

/// Does the problem have a solution? The load against the cone of admissible rigid motions
/// (TR965 (1.70)–(1.71)): a solution exists exactly if the load does no positive work on any of
/// them, that is (Farkas) if multipliers that the laws can carry balance it, Nᵀλ = e.
struct Solvability {
  enum class Verdict {
    unique,        ///< solvable; the load works against every admissible motion
    up_to_motion,  ///< solvable; `motion` changes nothing (the stress is unique)
    unsolvable,    ///< the load does positive work on the admissible motion `motion`
  };
  Verdict verdict = Verdict::unique;
  /// Solvable, but the least turn of the load (by 1e-6) makes it unsolvable.
  bool limit = false;
  algebra::Vector motion;  ///< amounts of the modes, greatest 1; empty for unique
  double work = 0;         ///< of the load on `motion`
  algebra::DenseMatrix two_sided;  ///< basis of the motions that no row notices: modes × count
};
Solvability solvability(const RigidMotions& rigid, const Problem& problem);

}  // namespace dotyk::problem
