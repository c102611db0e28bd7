#pragma once

#include <string>
#include <vector>

#include "algebra/krylov/repeated_systems.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// One body's systems K x_i = b_i with one K, and how each was solved.
struct RepeatedSolution {
  std::vector<std::string> names;               ///< of the systems: load cases, or "analysis", "sensitivity 1", …
  std::vector<algebra::SystemResult> systems;
  std::vector<std::vector<double>> solutions;   ///< of each: node × dimension
  std::vector<double> energies;                 ///< of each: x_iᵀ b_i
  std::shared_ptr<const mesh::Mesh> mesh;
  int unknowns = 0;
  double setup_seconds = 0;  ///< of the factor or the preconditioner
  double bytes = 0;          ///< beside K: factor, preconditioner, vectors kept; at their greatest
  int kept = 0;              ///< vectors kept for a next system
  bool converged() const;
};

/// The displacements under each of these load cases alone. Throws InputError unless the scene is one body, held by
/// what it is fixed to and elastic supports alone: no contact, no laws, no free motion; and for an unknown case.
RepeatedSolution solve_load_cases(const Scene& scene, const std::vector<std::string>& cases,
                                  const algebra::RepeatedSettings& settings, Monitor& monitor);

/// The displacement u under all loads, and its derivatives with respect to design variables α_i that move the nodes with
/// the velocities V_i (node × dimension each), P7 (6):
///   K ∂u/∂α_i = ∂f/∂α_i − (∂K/∂α_i) u,
/// both exact, see scene/result/load_derivative.hpp: tractions and body forces are given per area and volume and keep their directions,
/// pressures follow the normal, springs are per area, prescribed displacements stay as they are. Throws as above, and what
/// require_differentiable() throws.
RepeatedSolution solve_sensitivities(const Scene& scene, const std::vector<std::vector<double>>& velocities,
                                     const algebra::RepeatedSettings& settings, Monitor& monitor);

}  // namespace dotyk::scene
