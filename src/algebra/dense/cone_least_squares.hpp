#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A product of closed convex sets for consecutive variables: first intervals, one variable each, then discs and cones.
struct ConvexSet {
  /// ‖t‖ ≤ radius for 1 or 2 components t; or, with a slope, n ≥ 0 before them and ‖t‖ ≤ slope · n.
  struct Round {
    int components;
    double radius, slope;  ///< slope 0: the disc, else the cone
    int variables() const { return components + (slope > 0 ? 1 : 0); }
  };
  std::vector<double> low, high;  ///< of the intervals; ends may be infinite
  std::vector<Round> rounds;
};

struct ConeLeastSquares {
  Vector x;         ///< in the set
  Vector residual;  ///< b − Aᵀ x
  int steps = 0;    ///< of Newton's method: one sparse factorisation each
  /// The residual is least, or no more than asked for. Else it is of an x in the set all the same.
  bool converged = false;
};

/// Minimises ‖b − Aᵀ x‖ over x in a convex set C, for a sparse A of many rows and columns (rows: variables). The proximal point method
///   x⁺ = argmin ½‖b − Aᵀx‖² + ‖x − x_k‖²/2s,  by its dual: x⁺ = Π(x_k + s A w), where w solves  w = b − Aᵀ Π(x_k + s A w),
/// the optimality condition of a strongly convex function of w, with a damped semismooth Newton method: its matrices I + s AᵀDA, with D a
/// derivative of the projection Π, are positive definite and as sparse as AᵀA. s grows (R. T. Rockafellar 1976; X. Li, D. Sun, K.-C. Toh,
/// A highly efficient semismooth Newton augmented Lagrangian method for solving Lasso problems, 2018). A's entries are to be of
/// the order of 1. Begins with the shortest x that is best without C, where that lies in C. Ends where ‖b − Aᵀx‖ ≤ enough · ‖b‖ as well.
/// Asks at every step whether to stop (see ask_to_stop()).
ConeLeastSquares cone_least_squares(const SparseRows& A, const Vector& b, const ConvexSet& set, double enough = 1e-13);

}  // namespace dotyk::algebra
