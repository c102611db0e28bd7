#pragma once

#include <optional>

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// The full generalised Newton method on normal and tangential part together (TR965's open question,
/// (2.27), (3.23)), on the condensed problem: with x = x₀ − Wλ + Nα,
///   F_n = λ_n − P(λ_n + ρ x_n),   F_t = λ_t − π_b(λ_t + ρ x_t),   Nᵀλ = e,
/// b the bound of given friction or μ (λ_n + ρ x_n)⁺ for Coulomb, with the exact derivative of both
/// projections. Takes every scalar law as well. Steps are damped and guarded; where they do not come near a
/// solution, other methods follow, and of small problems with Coulomb friction search_pieces(), which may find that there is none (InputError).
///
/// Is the derivative regular? In scaled unknowns (natural_map.hpp) it is G = I − S(I − W̃). Eliminating u
/// from (2.27) gives det G(y) = det A det G, and, u in the norm of A, σ/(σ + 1 + M) ≤ σ_min(G(y)) ≤ σ = σ_min(G);
/// m, M the least and greatest eigenvalue of W̃, κ = M/m, d = ‖I − W̃‖ = max(M − 1, 1 − m).
///   Given friction: S is symmetric, 0 ≤ S ≤ I. Let Gv = r, a = v − r, c = W̃v − r. Then (I − S)a + Sc = 0,
/// so that a·c ≤ 0 in an eigenbasis of S, and c = W̃a + (W̃ − I)r. Hence m‖a‖² ≤ d‖a‖‖r‖ and
///   σ_min(G) ≥ m/(m + d) > 0
/// for bodies that are held and B of full rank, in the plane and in space, on all pieces.
///   Coulomb friction: slip along t adds a_t = μ a_n, thus a·c ≤ μ‖a‖‖c‖; as aᵀW̃a ≥ q‖a‖‖W̃a‖ with
/// q = 2√κ/(1 + κ), for μ < q (sufficient, not necessary; one point: μ < W_nn/|W_nt|)
///   σ_min(G) ≥ 1/(1 + (1 + μ)d/((q − μ)m)).
///   Free bodies: the derivative is singular exactly where the pieces leave a rigid motion free, SNα = 0 (given
/// friction): everything open, or everything slips.
struct Newton : RowMethod {
  /// Multiplies 1/W_rr, the stiffness (force per displacement) that each row sees.
  double rho = 1.0;
  double map_weight() const override { return rho; }
  /// Whether the history has the least singular value of each step's derivative exactly; else an estimate
  /// from its factors, 1/‖G⁻¹‖₁, right up to the root of the number of rows.
  bool watch = false;
  /// Starts at random multipliers, the same for the same seed: uniform in a box around 0 whose size, itself
  /// random, is from a tenth to a hundred times the multipliers with all that touches stuck.
  std::optional<unsigned> seed;
  const char* name() const override { return "newton"; }
  bool hands_over() const override { return true; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver
