#include "meshfile/between.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::meshfile {
namespace {

[[noreturn]] void refuse(const std::string& what, const double* point, int dimension, const std::string& why) {
  throw InputError(text(what, ": its cells do not fit together near ", point_text(point, dimension), ": ", why));
}

/// Node of the mesh → the point that the file has for it, or -1.
std::vector<int> given(const mesh::Mesh& mesh, const std::vector<int>& between, const std::vector<double>& points, const std::vector<int>& number,
                       const std::string& what) {
  const mesh::ElementTopology& t = mesh.topology();
  const int each = t.nodes - t.corners;
  std::vector<int> point_of(mesh.node_count(), -1), node_of(points.size() / 3, -1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < each; ++k) {
      const int point = between[static_cast<std::size_t>(c) * each + k], node = mesh.cell(c)[t.corners + k];
      if (point < 0) continue;
      const double* x = &points[3 * static_cast<std::size_t>(point)];
      if (number[point] >= 0) refuse(what, x, t.dimension, "a node between corners of one is a corner of another");
      if (node_of[point] >= 0 && node_of[point] != node) refuse(what, x, t.dimension, "a node lies between several pairs of corners");
      if (point_of[node] >= 0 && point_of[node] != point) refuse(what, x, t.dimension, "two nodes lie between the same corners");
      node_of[point] = node;
      point_of[node] = point;
    }
  return point_of;
}

/// Puts node k of cell c, which lies between corners that are not the ends of one edge, where the cell's edges have it.
void place(mesh::Mesh& mesh, int c, int k) {
  const mesh::ElementTopology& t = mesh.topology();
  const std::vector<int>& corners = t.between[k - t.corners];
  const auto has = [&](int corner) { return std::find(corners.begin(), corners.end(), corner) != corners.end(); };
  std::vector<int> edges;
  for (std::size_t e = 0; e < t.between.size(); ++e)
    if (t.between[e].size() == 2 && has(t.between[e][0]) && has(t.between[e][1])) edges.push_back(t.corners + static_cast<int>(e));
  const double weight = (1 + 0.25 * static_cast<double>(corners.size())) / static_cast<double>(edges.size());
  double* x = &mesh.coordinates[static_cast<std::size_t>(mesh.cell(c)[k]) * t.dimension];
  for (int i = 0; i < t.dimension; ++i) {
    double sum = 0;
    for (const int corner : corners) sum -= 0.25 * mesh.node(mesh.cell(c)[corner])[i];
    for (const int edge : edges) sum += weight * mesh.node(mesh.cell(c)[edge])[i];
    x[i] = sum;
  }
}

}  // namespace

mesh::Mesh with_nodes_between(mesh::Mesh first, const std::vector<int>& between, const std::vector<double>& points,
                              const std::vector<int>& number, const std::string& what) {
  mesh::Mesh mesh = mesh::second_order(std::move(first));
  const mesh::ElementTopology& t = mesh.topology();
  const std::vector<int> point_of = given(mesh, between, points, number, what);
  for (int n = 0; n < mesh.node_count(); ++n)
    if (point_of[n] >= 0)
      std::copy_n(&points[3 * static_cast<std::size_t>(point_of[n])], t.dimension, &mesh.coordinates[static_cast<std::size_t>(n) * t.dimension]);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = t.corners; k < t.nodes; ++k)
      if (point_of[mesh.cell(c)[k]] < 0 && t.between[k - t.corners].size() > 2) place(mesh, c, k);
  return mesh;
}

std::vector<int> all_nodes(const mesh::ElementTopology& t, std::vector<int> order) {
  const auto sorted = [](std::vector<int> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const std::vector<int> corner = order;
  for (const std::vector<int>& own : t.between) {
    std::vector<int> image;
    for (const int k : own) image.push_back(corner[k]);
    int node = t.corners;
    while (sorted(t.between[node - t.corners]) != sorted(image)) ++node;
    order.push_back(node);
  }
  return order;
}

}  // namespace dotyk::meshfile
