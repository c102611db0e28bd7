#pragma once

#include "contact/sides.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// The sides that have multipliers. Order 1: sides() and nodes(). Order 2: those at the facets' corners, each standing for the mean
/// with the corner's dual hat, see ContactRow and dual_hats.hpp; their weight is ∫ψ.
std::vector<NodeSide> corner_sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);
std::vector<NodeSide> corner_nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// Makes the mean of a corner's side of order 2 one over those of its facets that are `used` (one flag a facet of the part), and
/// its weight that part's; weight 0 where none is.
void take_mean(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<char>& used, NodeSide& side);

/// The linear (bilinear) hat of a corner at a facet's point; of order 1 the shape function itself.
double linear_hat(const mesh::ElementTopology& topology, const elasticity::FacetPoint& point, int corner);

}  // namespace dotyk::contact
