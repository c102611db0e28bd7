#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace dotyk::plate {

/// An edge of the mesh, from node[0] to node[1] counter-clockwise about its first cell.
struct Edge {
  std::array<int, 2> node;
  int cell;                ///< its first, on the boundary its only one
  bool boundary = false;
  double length = 0;
  Eigen::Vector2d middle, tangent, normal;  ///< units; the normal out of its first cell
};

struct Edges {
  std::vector<Edge> edges;
  std::vector<std::array<int, 3>> of_cell;   ///< edge of each facet of a cell
  /// 1, or −1 where the edge's normal points into the cell.
  double sign(int cell, int local) const { return edges[of_cell[cell][local]].cell == cell ? 1 : -1; }
};

/// The node in the plane.
inline Eigen::Vector2d node_position(const mesh::Mesh& mesh, int node) { return {mesh.node(node)[0], mesh.node(node)[1]}; }

Edges find_edges(const mesh::Mesh& mesh);

/// The boundary at a node where it turns by less than 35° counts as smooth: as that of a curve that the mesh approximates. There
/// laws act along the curve's own normal and tangent, not the edges', lest a polygon's solution be taken for the
/// curve's: Babuška's paradox (Bartels and Tscherner 2023).
struct BoundaryNode {
  std::vector<int> edges;           ///< of the boundary, that meet here
  bool smooth = false;
  Eigen::Vector2d normal{0, 0};     ///< mean of the edges', a unit; where smooth
};

/// One a node of the mesh; those within have no edges.
std::vector<BoundaryNode> find_boundary_nodes(const mesh::Mesh& mesh, const Edges& edges);

/// How far the curve through the ends of a boundary edge, with the nodes' normals, stands out of the edge's middle: length
/// × (angle of the normals)/8, which is right for a circle to its third power.
double sagitta(const Edge& edge, const std::vector<BoundaryNode>& nodes);

}  // namespace dotyk::plate
