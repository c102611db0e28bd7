#pragma once

#include <functional>

#include "base/monitor.hpp"
#include "problem/condensed.hpp"

namespace dotyk::solver {

/// Is there a solution at all, on any pieces of the laws? Its rows are linear equations in columns z with bounds,
///   x = x₀ − Wλ + Nα,  Nᵀλ = e,  λ = λ⁺ − λ⁻,  x = λ⁺/k⁺ − λ⁻/k⁻ + q⁺ − q⁻ (a scalar law; q beyond the greatest and the least λ),
///   λ_n = a + b,  λ_t = μ(a − b),  x_t = q⁺ − q⁻ (Coulomb friction in the plane),
/// and of certain pairs of columns one is at a bound: q⁻ or λ⁻ (open or closed), b or q⁺, a or q⁻ (stick or slip), … Without the
/// pairs it is a linear programme. Where that has no point there is no solution: no pressures that the bodies can build up, with
/// friction within its cones, balance the load. Else a pair that its point breaks splits the search in two. "No solution" is meant of columns
/// that are at most 10⁴ times the right side (more where springs of laws are softer than what their rows see).
struct PieceSearch {
  enum class Verdict { none, found, near, undecided };
  Verdict verdict = Verdict::undecided;
  int programmes = 0;            ///< linear ones that were solved
  bool given_up = false;         ///< undecided after some seconds' work
  algebra::Vector lambda, alpha; ///< the solution, where one is found; where it is near, of the polygons
};

/// Tries a method from (λ, α). True if it converges; the arguments then hold the solution.
using Attempt = std::function<bool(algebra::Vector& lambda, algebra::Vector& alpha)>;

/// `attempt` is made from the point of each programme: it may find a solution long before the search has come to its pieces.
/// In space discs of friction are replaced by polygons around them, and slip is along the force up to the polygon's angle: the search then
/// proves that there is no solution, or finds where to begin another method from. Undecided as well where a law does not tell its springs, beyond so many rows, and after so much work.
PieceSearch search_pieces(const problem::Problem& problem, const problem::CondensedProblem& condensed, const Attempt& attempt,
                          Monitor& monitor);

}  // namespace dotyk::solver
