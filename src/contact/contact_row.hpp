#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/point.hpp"

namespace dotyk::contact {

/// A node, and its share in a mean over nodes.
struct NodeWeight {
  int node;
  double weight;
  bool operator==(const NodeWeight&) const = default;
};

/// Σ weight v of the nodes' vectors, `nodal` (node × dimension): with weights 1 in sum their mean.
inline mesh::Point mean(const std::vector<NodeWeight>& nodes, const std::vector<double>& nodal, int dimension) {
  mesh::Point sum{0, 0, 0};
  for (const NodeWeight& n : nodes)
    for (int i = 0; i < dimension; ++i) sum[i] += n.weight * nodal[static_cast<std::size_t>(n.node) * dimension + i];
  return sum;
}
inline mesh::Point mean_place(const std::vector<NodeWeight>& nodes, const mesh::Mesh& mesh) { return mean(nodes, mesh.coordinates, mesh.dimension()); }

/// One condition of non-penetration at a corner of the first part's facets:
///   normal·(Σ weight u_own − Σ weight u_partner) ≤ gap        (no partners against a rigid shape)
/// Cells of order 1: a node is its own alone. Order 2: the condition is asked for in the mean with the corner's dual hat ψ (DualHats),
/// own weights are ∫ψφ_k/∫ψ, so that the pressure is piecewise linear: one order less than the displacement, as is stable
/// (Hild and Laborde 2002; in space, with dual hats, Wohlmuth, Popp, Gee and Wall 2012). Nodal conditions would not do: on
/// quadratic triangles ∫φ of a corner is 0. Hats of their own would do, but the pressure they give swings about the true one
/// next to the contact's edge, as continuous projections of a function with a kink do; that of dual hats, local means, does not.
struct ContactRow {
  int node;                         ///< of the first body's mesh
  std::vector<NodeWeight> own;       ///< of the first body, 1 in sum; `node` first
  std::vector<NodeWeight> partners{};  ///< of the second body, 1 in sum; matching nodes of order 1: one. See pairing.hpp
  mesh::Point normal;   ///< unit, out of the first body; one for both sides, see frame.hpp
  double gap = 0;       ///< at rest, positive when open; `added` included
  double weight = 0;    ///< length or area that the node stands for
  std::vector<int> facets;  ///< of the first part, those of the row's side at the node
  double added = 0;         ///< what was added to the geometric gap
  std::array<mesh::Point, 3> mix{};  ///< how the normals of both sides make `normal`, see frame.hpp
  double chord = 0;         ///< how far facets there are from the curves that they are chords of: what the gap is uncertain by, see pairing.hpp
  double turn = 0;          ///< angle that `normal` is uncertain by, since facets are chords; 0 where a rigid shape's decides
};

/// A node of the first part that moves with what lies across from it: Σ weight u_own = Σ weight u_partner; `own` is the node
/// alone but in a mortar mean of order 2.
struct Tie {
  int node;
  std::vector<NodeWeight> own;
  std::vector<NodeWeight> partners;
};

/// The axis that the first tangent in space lies along, made perpendicular: the one that n is least along.
inline int tangent_axis(const mesh::Point& n) {
  int least = 0;  // axes stay axes where they can
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[least]) - 1e-12) least = i;
  return least;
}

/// Unit tangents to the unit normal n: in the plane the one that n turned by 90° anticlockwise is; in space two,
/// perpendicular to each other, along axes where n is along one.
inline std::vector<mesh::Point> tangents(const mesh::Point& n, int dimension) {
  if (dimension == 2) return {{-n[1], n[0], 0}};
  const int least = tangent_axis(n);
  mesh::Point t = mesh::times(-n[least], n);
  t[least] += 1;
  const double size = mesh::length(t);
  for (double& v : t) v = std::abs(v) < 1e-15 ? 0 : v / size;
  return {t, mesh::cross(n, t)};
}

}  // namespace dotyk::contact
