#include "shape/derivative/sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "shape/design/chain.hpp"

namespace dotyk::shape {
namespace {

constexpr double kCorner = 0.86602540378443864676;  ///< cos 30°

using Way = std::map<int, int>;  ///< boundary node → the next one

bool turns(const mesh::Mesh& mesh, int a, int b, int c) {
  const double *x = mesh.node(a), *y = mesh.node(b), *z = mesh.node(c);
  const double along = (y[0] - x[0]) * (z[0] - y[0]) + (y[1] - x[1]) * (z[1] - y[1]);
  return along < kCorner * plane_distance(x, y) * plane_distance(y, z);
}

/// The nodes of the side that begins at the end of the part: up to its corner, or a node that holds.
std::vector<int> side(const mesh::Mesh& mesh, const Way& way, int end, const std::vector<char>& holds) {
  std::vector<int> nodes{end};
  for (auto to = way.find(end); to != way.end() && to->second != end; to = way.find(nodes.back())) {
    if (nodes.size() > 1 && (holds[nodes.back()] || turns(mesh, nodes[nodes.size() - 2], nodes.back(), to->second))) break;
    nodes.push_back(to->second);
  }
  return nodes;
}

void interpolate(const mesh::Mesh& mesh, const std::vector<int>& nodes, algebra::DenseMatrix& V) {
  std::vector<double> length{0};
  for (std::size_t k = 1; k < nodes.size(); ++k) length.push_back(length.back() + plane_distance(mesh.node(nodes[k - 1]), mesh.node(nodes[k])));
  const algebra::DenseMatrix from = V.middleRows(2 * nodes.front(), 2), to = V.middleRows(2 * nodes.back(), 2);
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const double t = length[k] / length.back();
    V.middleRows(2 * nodes[k], 2) = (1 - t) * from + t * to;
  }
}

}  // namespace

void move_sides(const BoundaryMotion& motion, const std::vector<char>& fixed, algebra::DenseMatrix& V) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  std::vector<char> holds = fixed;
  for (const int node : motion.nodes) holds[node] = 1;
  std::map<int, int> moving;
  for (const mesh::Facet f : motion.part.facets) moving[mesh.facet_node(f, 0)] = mesh.facet_node(f, 1);
  Way forward, backward;  // over the rest of the boundary
  for (const mesh::Facet f : mesh::boundary(mesh)) {
    const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
    if (const auto part = moving.find(a); part == moving.end() || part->second != b) forward[a] = b, backward[b] = a;
  }
  for (const int node : motion.nodes)
    for (const Way* way : {&forward, &backward})
      if (way->count(node)) interpolate(mesh, side(mesh, *way, node, holds), V);
}

}  // namespace dotyk::shape
