#pragma once

#include "contact/sides.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// The sides that have multipliers. Order 1: sides() and nodes(). Order 2: those at the facets' corners, each standing for the mean
/// with the corner's dual hat, see ContactRow and dual_hats.hpp, over those facets of the part that are `used` (one flag each; none
/// given: all); their weight is ∫ψ there, and corners of no such facet are left out.
std::vector<NodeSide> corner_sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<char>& used = {});
std::vector<NodeSide> corner_nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// The linear (bilinear) hat of a corner at a facet's point; of order 1 the shape function itself.
double linear_hat(const mesh::ElementTopology& topology, const elasticity::FacetPoint& point, int corner);

}  // namespace dotyk::contact
