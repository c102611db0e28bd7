#pragma once

#include <optional>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// How far a solution is from another one of the same bodies and contacts, which is taken for exact: usually that of a
/// finer mesh. All relative to the reference's own size.
struct Distance {
  /// |u − ū|_E / |ū|_E in the energy norm (energy_norm.hpp) on the reference's meshes: u is
  /// interpolated to their nodes, which is exact where the reference's meshes refine the solution's.
  double energy = 0;
  /// ‖u − ū‖ / ‖ū‖ in L2 over the bodies, at the nodes of the reference's meshes by their share ∫φ of the volume.
  double displacement = 0;
  /// ‖p − p̄‖ / ‖p̄‖ in L2 over the contacts, at the solution's contact nodes by their weights. p̄ between its nodes: in
  /// the plane on the line between the neighbours, in space the mean of the nearest four by the inverse squares of
  /// their distances. Empty where the scene has no contact.
  std::optional<double> pressure;
  /// |max p / max p̄ − 1|. Empty likewise.
  std::optional<double> peak_pressure;
};

/// A node of the reference that lies outside the solution's mesh (curved boundaries) takes the displacement of the
/// nearest cell, continued. Throws InputError where bodies, contacts or shapes differ, and where the reference is zero.
Distance distance(const Solution& solution, const Solution& reference);

}  // namespace dotyk::scene
