#pragma once

#include "algebra/types.hpp"
#include "base/monitor.hpp"
#include "contact/multipliers.hpp"

namespace dotyk::contact {

/// Functions on a surface as sums over its facets (or halves of edges), bilinear in the coarse hats' values.
/// A multiplier's density: `corner[a]` at the facet's corners, on the half next to corner `half` or (-1) all of it.
struct DensityPiece {
  int facet;  ///< of the surface
  int half;
  double corner[4];
};
using Density = std::vector<DensityPiece>;

/// The norm of H^{-1/2}(Γ_c), the dual of the traces' space, realised on a refined surface. With A = L + M/ℓ² the
/// Gram matrix of H¹ and M that of L² on continuous piecewise linear functions w on every facet cut into kCuts
/// equal parts each way, the trace norm is the one between them by interpolation, ‖w‖²_{1/2} = wᵀM(M⁻¹A)^{1/2}w, and
///   ‖μ‖²_{-1/2} = sup_w ⟨μ, w⟩²/‖w‖²_{1/2} = mᵀ (M⁻¹A)^{-1/2} M⁻¹ m = (2/π)∫₀^∞ mᵀ(t²M + A)⁻¹ m dt,  m_i = ∫ μ φ_i.
/// Where `moves` is false traces vanish, and the space is the one between L² and H¹ functions that vanish there.
/// On a straight line or plane the norm of a wave cos(kx) is its L² norm times (k² + 1/ℓ²)^{-1/4}. Surfaces that
/// hang together only at their edges' nodes are normed one by one.
/// Returns the Gram matrix of the densities. The integral is taken by the trapezoidal rule in log t, to 1e-4. Throws Interrupted
/// where the monitor asks to stop.
algebra::DenseMatrix trace_gram(const Surface& surface, const std::vector<char>& moves,
                                const std::vector<Density>& densities, double length, Monitor& monitor);

/// Parts that a facet's edge is cut into: functions constant on facets are seen by some φ inside each.
inline constexpr int kCuts = 4;

}  // namespace dotyk::contact
