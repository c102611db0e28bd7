#pragma once

#include <optional>
#include <vector>

#include "scene/statement/loading.hpp"

namespace dotyk::scene {

/// What changes when a body's nodes move with the velocity V (node × dimension), exactly; of contact rows see contact/row_derivative.hpp.
/// What is given per area or volume stays with its material point, as in moved().

/// d/dt of the body's nodal loads under a loading (node × dimension): tractions and body forces keep their directions, pressures
/// follow the normal. Loads by laws, which require_differentiable() lets rest, are none of them.
std::vector<double> load_derivative(const Body& body, const Loading& loading, const std::vector<double>& V);

/// d/dt of elasticity::internal_force() of the displacement u (node × dimension) with springs: (dK) u.
std::vector<double> internal_force_derivative(const Body& body, const std::vector<double>& u, const std::vector<double>& V);

/// The first of the facets with a node that moves, by more than 1e-12 of V's greatest component, which is rounding. None where all rest; V may be empty.
std::optional<mesh::Facet> moving_facet(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<double>& V);

/// Throws InputError where what supports hold changes with V (a body each; empty where it rests) in a way that has no derivative here,
/// naming the part and what to do: the normal of a slide turns, the part of a law's support moves, or that of a contact with a rigid
/// gap. A body that moves is of cells of order 1. Normals that turn by less than 1e-9 of what V could turn them by, and V below 1e-12 of its greatest, are taken as rounding.
void require_differentiable(const Scene& scene, const std::vector<std::vector<double>>& V);

}  // namespace dotyk::scene
