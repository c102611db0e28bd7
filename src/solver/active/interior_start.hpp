#pragma once

#include "base/monitor.hpp"
#include "solver/active/held_stiffness.hpp"

namespace dotyk::solver {

/// Where an interior point method ended, moved onto the laws: λ ∈ ∂φ(x) in every row.
struct InteriorPointState {
  algebra::Vector lambda, x;
  int iterations = 0;  ///< 0: it did not begin, for want of a load or because nothing holds the body
};

/// A barrier method (program::Barrier) on the whole problem with
///   x = Bu − c = λ/k + z⁺ − z⁻,   z⁺(high − λ) = z⁻(λ − low) = μ → 0,   Ku + Bᵀλ = f,
/// low, high and k (by the side that λ is on) each law's. A step needs
///   (K + BᵀD⁻¹B) du = …,   D = 1/k + z⁺/(high − λ) + z⁻/(λ − low),
/// one sparse Cholesky factorisation; their number hardly grows with the mesh. `tol`: of μ against
/// load and displacement. Throws nothing; what it gives is where to begin, no solution.
InteriorPointState interior_start(const problem::Problem& problem, HeldStiffness& stiffness, double tol, Monitor& monitor);

}  // namespace dotyk::solver
