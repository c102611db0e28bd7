#pragma once

#include <array>
#include <vector>

#include "elasticity/stress.hpp"

namespace dotyk::elasticity {

/// Squares of the parts of an estimate of the energy norm ‖u − u_h‖, ‖v‖² = ∫ ε(v):c:ε(v): force·length.
///
/// For every stress σ* in equilibrium with the loads and with admissible tractions of contact the hypercircle holds
/// (Prager and Synge 1947; with contact: Bartels and Carstensen 2004; Weiss and Wohlmuth, SIAM J. Numer. Anal. 47, 2009)
///   ‖u − u_h‖² + ‖σ − σ*‖² ≤ ‖σ* − σ_h‖² + 2·(what u_h and the tractions lack of complementarity and friction's law),
/// norms of stress ∫ τ:c⁻¹:τ. The σ* taken here is the recovered stress (Zienkiewicz and Zhu 1987, 1992), which is near
/// σ, but only nearly in equilibrium; what it lacks is measured by the stress that would mend it, cell by cell:
///   recovery   ∫ (σ* − σ_h):c⁻¹:(σ* − σ_h)
///   bulk       (h/π)² ∫ (f + div σ*)²/m, h the cell's longest edge, h/π Poincaré's constant of a simplex (Payne and
///              Weinberger 1960: its diameter) or a box, m the mean stiffness of a wave, tr Q/d over the axes
///   jump       H/3 ∫ r·Q⁻¹r, r the jump of σ*n where the material jumps: σ* is recovered on either side apart
///   boundary   the same with r = t − σ*n on the boundary with traction t given, springs included
///   contact_pressure, friction   the same with the normal and the tangential part of r on the contact boundary, t the
///              traction that the multipliers are; friction also has what slip and shear lack of its law
///   complementarity   2∫ λ gap: where a facet has one closed and one open node
///   laws       what elastic laws of supports lose by acting at nodes: see scene/result/energy_norm.hpp
/// H the cell's height over the facet, Q_ik = c_ijkl n_j n_l: a stress that falls linearly from rn on the facet to 0
/// has the energy H/3 ∫ r·Q⁻¹r. No constant is fitted. Not measured: what interpolation loses of prescribed
/// displacements and of the gap, and what facet means lose of loads (all of higher order where they are smooth); the
/// jump across glued facets.
struct ErrorParts {
  double recovery = 0, bulk = 0, jump = 0, boundary = 0, contact_pressure = 0, complementarity = 0, friction = 0, laws = 0;
  double sum() const { return recovery + bulk + jump + boundary + contact_pressure + complementarity + friction + laws; }
  ErrorParts& operator+=(const ErrorParts& other);
};

/// What is known of the traction on a facet of the boundary.
struct FacetTraction {
  mesh::Facet facet;
  std::array<mesh::Point, 4> traction{};  ///< at its nodes, force per length or area; linear (bilinear) between
  /// Orthogonal projection onto the directions in which it is known; 0: in none.
  std::array<std::array<double, 3>, 3> known{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  bool contact = false;
  /// Known no more along this unit vector.
  void forget(const mesh::Point& direction);
};

struct ErrorEstimate {
  std::vector<ErrorParts> cells;
  std::vector<double> solution;  ///< ∫ σ_h:c⁻¹:σ_h of each cell
};

/// The estimate for one body of the nodal displacement u (node × dimension). `force`: per volume, the mean of each
/// cell, or empty; `boundary`: facets without an entry are not looked at. Where Hooke's tensor jumps by more than a
/// fifth across a facet, stresses are recovered on either side apart; otherwise `recovered`, if given, is what
/// recover_stress gives, and not made again. The parts of contact that need gaps and slips, and those of laws, are left 0.
ErrorEstimate estimate_error(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                             const std::vector<mesh::Point>& force, const std::vector<FacetTraction>& boundary,
                             const std::vector<Stress>* recovered = nullptr);

/// H/3 and Q⁻¹ of a facet: the weight of a traction that is missing there, as above.
struct TractionWeight {
  double depth;
  std::array<std::array<double, 3>, 3> inverse;
};
TractionWeight traction_weight(const mesh::Mesh& mesh, const Hooke& hooke, mesh::Facet facet);

}  // namespace dotyk::elasticity
