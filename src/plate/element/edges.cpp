#include "plate/element/edges.hpp"

#include <cmath>
#include <unordered_map>

#include "mesh/edge_key.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

namespace {

const double kCorner = std::cos(35 * M_PI / 180);

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

Edges find_edges(const mesh::Mesh& mesh) {
  Edges out;
  out.of_cell.resize(mesh.cell_count());
  std::unordered_map<std::uint64_t, int> place;
  place.reserve(static_cast<std::size_t>(mesh.cell_count()) * 2);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.cell(c)[k], b = mesh.cell(c)[(k + 1) % 3];
      const auto [found, fresh] = place.emplace(mesh::edge_key(a, b), static_cast<int>(out.edges.size()));
      out.of_cell[c][k] = found->second;
      if (!fresh) {
        out.edges[found->second].boundary = false;
        continue;
      }
      Edge edge{{a, b}, c, true, 0, {}, {}, {}};
      const Vector2d along = node_position(mesh, b) - node_position(mesh, a);
      edge.length = along.norm();
      edge.middle = (node_position(mesh, a) + node_position(mesh, b)) / 2;
      edge.tangent = along / edge.length;
      edge.normal = {edge.tangent[1], -edge.tangent[0]};
      out.edges.push_back(edge);
    }
  return out;
}

std::vector<BoundaryNode> find_boundary_nodes(const mesh::Mesh& mesh, const Edges& edges) {
  std::vector<BoundaryNode> nodes(mesh.node_count());
  for (std::size_t e = 0; e < edges.edges.size(); ++e)
    if (edges.edges[e].boundary)
      for (const int n : edges.edges[e].node) nodes[n].edges.push_back(static_cast<int>(e));
  for (BoundaryNode& node : nodes) {
    if (node.edges.size() != 2) continue;
    const Vector2d a = edges.edges[node.edges[0]].normal, b = edges.edges[node.edges[1]].normal;
    node.smooth = a.dot(b) > kCorner;
    if (node.smooth) node.normal = (a + b).normalized();
  }
  return nodes;
}

double sagitta(const Edge& edge, const std::vector<BoundaryNode>& nodes) {
  const BoundaryNode &a = nodes[edge.node[0]], &b = nodes[edge.node[1]];
  if (!a.smooth && !b.smooth) return 0;
  const double at_a = cross(a.normal, edge.normal), at_b = cross(edge.normal, b.normal);
  return edge.length / 8 * (a.smooth && b.smooth ? at_a + at_b : 2 * (at_a + at_b));
}

}  // namespace dotyk::plate
