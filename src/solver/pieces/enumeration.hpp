#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// What a row does: λ = 0; x = 0 (a friction point sticks); λ_t = b with x_t ≥ 0; λ_t = −b with x_t ≤ 0.
enum class RowPiece : char { open, closed, forward, backward };

/// All solutions of a problem in the plane with few contact points. On each combination of pieces the natural
/// map is affine: one linear system, whose solution solves the problem where the signs and bounds of the pieces hold. A singular
/// system that is consistent has an affine space of solutions, which these inequalities cut to a polyhedron.
struct Enumeration {
  struct Solution {
    Result result;
    /// Every combination of pieces, row by row, that gives it: several where it lies on their edges.
    std::vector<std::vector<RowPiece>> pieces;
  };
  /// A polyhedron of solutions, in multipliers and motions: all convex combinations of its ends, on one combination of pieces.
  struct Family {
    int dimension = 1;
    std::vector<Solution> ends;
    int unbounded = 0;       ///< directions in which it has no end
    bool forces_only = false;  ///< its members differ in multipliers, not in displacements
    int connected = 0;       ///< number of the connected set that it belongs to, from 0
  };
  std::vector<Solution> solutions;  ///< the isolated ones, distinct, in the order found: open before stick before slip
  std::vector<Family> families;     ///< none a part of another one
  long tried = 0;
  long singular = 0;                ///< combinations with a singular system
  bool complete = true;             ///< false where the user stopped
  /// "3 solutions; all 64 combinations of pieces tried", "no isolated solution and a continuum of them: …".
  std::string summary() const;
};

/// Tries all combinations: 2 for a contact row, 4 for one with Coulomb friction, 3 for a point with given
/// friction; rows of other laws have one piece. Throws InputError where there are more than 2²⁰, or friction has
/// two components (slip to any side: not finitely many pieces), or nothing stops a rigid motion.
Enumeration enumerate(const problem::Problem& problem, Monitor& monitor);

}  // namespace dotyk::solver
