#pragma once

#include <optional>

#include "base/monitor.hpp"
#include "scene/statement/scene.hpp"

namespace dotyk::scene {

enum class MultiplierPart { tangential, normal, both };

/// What an inf-sup constant is asked of.
struct InfSupSettings {
  MultiplierPart part = MultiplierPart::tangential;
  bool share_fixed = true;      ///< false: multipliers stay at nodes that supports hold on both sides, and at corners
  bool own_norm = false;        ///< the norm of μ_t itself, as in (3.16), not of the shear g_h μ_t
  bool cone = false;            ///< also over the cone of (3.16)
};

/// The stability of a contact's multipliers against the displacements, TR965 (3.16): the greatest β with
///   sup_v b(μ, v)/‖v‖₁ ≥ β ‖μ‖_{-1/2}  for all multipliers μ,
/// where v are the displacements of the contact's bodies (zero where supports prescribe them) in the Sobolev norm
/// ∫|∇v|² + |v|²/ℓ², and the norm of the pressure and of the shear g_h μ_t is contact::trace_gram's, ℓ the
/// diagonal of the box around the contact. With W = B A₁⁻¹Bᵀ (A₁ the Gram matrix of ‖·‖₁) and N that of
/// ‖·‖_{-1/2}, β² is the least eigenvalue of W μ = β² N μ. The material does not enter. For waves much shorter
/// than the bodies the continuous β is 1 against a rigid shape, √2 between two bodies.
struct InfSup {
  double constant = 0;      ///< β; 0 where there is a kernel
  double above_kernel = 0;  ///< the least of the β that are not 0
  int kernel = 0;           ///< dimension of the multipliers that no displacement notices (3.15)
  int multipliers = 0;      ///< rows
  double h = 0;             ///< contact::facet_width
  double H = 0;             ///< extent of the cells of friction: friction_size or its default
  std::optional<double> cone;  ///< over the cone of pressures ≥ 0, by steps of projected gradients from many starts: the least may be a little less
};

/// Throws InputError for a
/// glue, for nodes that do not match, and where the contact has no multiplier of that part (no friction); Interrupted where the
/// monitor asks to stop.
InfSup inf_sup(const Contact& contact, const InfSupSettings& settings, Monitor& monitor);

}  // namespace dotyk::scene
