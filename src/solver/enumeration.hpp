#pragma once

#include "solver/solver.hpp"

namespace dotyk::solver {

/// What a row does: λ = 0; x = 0 (a friction point sticks); λ_t = b with x_t ≥ 0; λ_t = −b with x_t ≤ 0.
enum class Piece : char { open, closed, forward, backward };

/// All solutions of a problem in the plane with few contact points. On each combination of pieces the natural
/// map is affine: one linear system, whose solution solves the problem where the map vanishes there.
struct Enumeration {
  struct Solution {
    Result result;
    /// Every combination of pieces, row by row, that gives it: several where it lies on their edges.
    std::vector<std::vector<Piece>> pieces;
  };
  std::vector<Solution> solutions;  ///< distinct ones, in the order found: open before stick before slip
  long tried = 0;
  /// Combinations with a singular, consistent system: a whole line or plane of candidates, of which only the
  /// least was tried. Solutions there may be missing; they are not isolated.
  long undecided = 0;
  bool complete = true;             ///< false where the user stopped
  std::string summary() const;      ///< "3 solutions; all 64 combinations of pieces tried", …
};

/// Tries all combinations: 2 for a contact row, 4 for one with Coulomb friction, 3 for a point with given
/// friction; rows of other laws have one piece. Throws InputError where there are more than 2²⁰, or friction has
/// two components (slip to any side: not finitely many pieces), or nothing stops a rigid motion.
Enumeration enumerate(const problem::Problem& problem, Monitor& monitor);

}  // namespace dotyk::solver
