#pragma once

#include <string>
#include <vector>

#include "contact/contact_row.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// A node of a boundary part as seen from one side of the part's (possibly broken) line or surface.
struct NodeSide {
  int node;
  mesh::Point normal;  ///< unit, outward: of the side's facets, weighted by their measure
  double weight;       ///< ∫ φ over the side's facets: length (2-D) or area; of corners of order 2 ∫ of the linear hat
  std::vector<int> facets;  ///< the side's facets at the node, as indices into the part's
  std::vector<NodeWeight> own;  ///< the nodes whose mean the side stands for, `node` first: itself alone, but see corner_sides()
};

/// Facets whose normals differ by more than this meet in an edge; below it the surface is taken
/// as smooth. Between what a coarse polygon of a circle has (12 edges: 30°) and real corners.
inline constexpr double kCornerAngle = 35.0;  // degrees

/// One entry a node and adjoining side, by node: at a vertex of a broken contact line (2-D) or where
/// several faces meet (3-D) there are several (TR965 (1.23)).
std::vector<NodeSide> sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// One entry a node, with all its facets' measure; the normal is their mean.
std::vector<NodeSide> nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// sides() of a part whose nodes have moved from the mesh `before` to `after`. Throws InputError, naming the part and the place,
/// where they are not, one for one, of the facets they were of: a corner has appeared, or gone.
std::vector<NodeSide> moved_sides(const mesh::Mesh& before, const mesh::Mesh& after, const std::vector<mesh::Facet>& facets,
                                  const std::string& part);

/// The sides that have multipliers. Order 1: sides() and nodes(). Order 2: those at the facets' corners, each standing for the mean
/// with the corner's dual hat, see ContactRow and dual_hats.hpp, over those facets of the part that are `used` (one flag each; none
/// given: all); their weight is ∫ψ there, and corners of no such facet are left out.
std::vector<NodeSide> corner_sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<char>& used = {});
std::vector<NodeSide> corner_nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// The linear (bilinear) hat of a corner at a facet's point; of order 1 the shape function itself.
double linear_hat(const mesh::ElementTopology& topology, const elasticity::FacetPoint& point, int corner);

}  // namespace dotyk::contact
