#include "meshfile/cells.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/memory.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::meshfile {
namespace {

/// Of order 1.
mesh::Element element(const Contents& c, const std::vector<const Block*>& blocks, const std::string& what) {
  std::map<Shape, std::set<std::string>> regions;
  for (const Block* b : blocks) {
    auto& here = regions[b->shape];
    for (const int g : b->groups) here.insert(c.groups[g].name);
  }
  if (regions.size() > 1) {
    std::string found;
    for (const auto& [shape, where] : regions)
      found += text(found.empty() ? "" : "; ", kind(shape).plural, where.empty() ? "" : " in " + list(where));
    throw InputError(text(what, ": a mesh has cells of one shape, and these are of several (", found,
                          "): load one region, or mesh with one shape"));
  }
  if (regions.empty()) throw InputError(what + ": these regions hold no cells");
  if (const auto cell = kind(regions.begin()->first).cell) return *cell;
  throw InputError(text(what, ": its cells are ", kind(regions.begin()->first).plural, "; there are elements for triangles, quadrilaterals, ",
                        "tetrahedra and hexahedra: mesh it with one of these"));
}

/// Places of nodes in the contents, cell by cell.
struct Cells {
  std::vector<int> corners, between;  ///< -1 where there is none between
};

/// The cells, each once; `between` nodes of each where they are asked for (not 0). `points`: how many there are.
Cells cells(const std::vector<const Block*>& blocks, int each, int between, int points) {
  Cells all, once;
  for (const Block* b : blocks) {
    all.corners.insert(all.corners.end(), b->nodes.begin(), b->nodes.end());
    if (between > 0) all.between.insert(all.between.end(), b->between.begin(), b->between.end());
    all.between.resize(all.corners.size() / each * between, -1);
  }
  const int count = static_cast<int>(all.corners.size() / each);
  const auto at = [&](int c) { return all.corners.begin() + static_cast<std::ptrdiff_t>(c) * each; };
  const Buckets by_first(points, [&](auto&& put) {
    for (int c = 0; c < count; ++c) put(*at(c), c);
  });
  for (int c = 0; c < count; ++c) {
    const auto alike = by_first[*at(c)];
    if (std::any_of(alike.begin(), alike.end(), [&](int b) { return b < c && std::equal(at(b), at(b) + each, at(c)); })) continue;
    once.corners.insert(once.corners.end(), at(c), at(c) + each);
    const auto first = all.between.begin() + static_cast<std::ptrdiff_t>(c) * between;
    once.between.insert(once.between.end(), first, first + between);
  }
  return once;
}

/// Plane meshes: z must not vary, by more than rounding of the file's numbers.
void check_plane(const Contents& c, const Cells& cells, const std::string& what) {
  mesh::Box box;
  for (const std::vector<int>* nodes : {&cells.corners, &cells.between})
    for (const int n : *nodes)
      if (n >= 0) box.add(mesh::at_node(c.points, n, 3));
  if (!(box.extent(2) > 1e-9 * std::max(box.extent(0), box.extent(1)))) return;
  for (int k = 0; k < 2; ++k)
    if (!(box.extent(k) > 1e-9 * box.extent(2)))
      throw InputError(text(what, ": its cells lie in a plane of constant ", "xy"[k], "; turn them into the plane of x and y"));
  throw InputError(what + ": its cells are a surface in space, not a solid and not in the plane of x and y; for a solid, mesh the volume");
}

/// The mesh of the corners; `number` gets the new numbers of the file's nodes, -1 for those left out.
mesh::Mesh compact(const Contents& c, mesh::Element element, std::vector<int> cells, std::vector<int>& number) {
  mesh::Mesh mesh;
  mesh.element = element;
  number.assign(c.points.size() / 3, -1);
  for (const int n : cells) number[n] = 0;
  int count = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = count++;
    for (int k = 0; k < mesh.dimension(); ++k) mesh.coordinates.push_back(c.points[3 * n + k]);
  }
  for (int& n : cells) n = number[n];
  mesh.cells = std::move(cells);
  return mesh;
}

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

/// The mesh of order 2 with the corners of `first`. `between` says, cell by cell in the order of
/// mesh::ElementTopology::between, where in `points` (3 × nodes) the nodes between the corners stand, -1 where a cell has
/// none of its own: then the node is that of a neighbour which has one, else what the serendipity interpolation has there,
/// x_edge = ½ Σ x_c over 2 corners, x_face = −¼ Σ x_c + ½ Σ x_e over 4 and 4, x_cell = −¼ Σ x_c + ¼ Σ x_e over 8 and 12.
/// That is the geometry of serendipity cells, and of straight ones. `number` gives the corners that the points are, or -1.
///
/// Throws InputError, beginning with `what`, where cells do not fit together: a point lies between corners and is a corner,
/// or lies between other corners, too; or two points between the same corners.
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

/// Of `order`, which mirrors the corners of a cell, what it does to all nodes of this cell type.
std::vector<int> all_nodes(const mesh::ElementTopology& t, std::vector<int> order) {
  const std::vector<int> corner = order;
  for (const std::vector<int>& own : t.between) {
    std::vector<int> image;
    for (const int k : own) image.push_back(corner[k]);
    order.push_back(mesh::node_between(t, image));
  }
  return order;
}

/// Puts left-handed cells into right-handed order; those twisted either way stay for mesh::check to refuse.
void turn_over(mesh::Mesh& mesh) {
  static const std::vector<int> mirrored[] = {{0, 2, 1}, {0, 3, 2, 1}, {0, 2, 1, 3}, {4, 5, 6, 7, 0, 1, 2, 3}};
  const std::vector<int> order = all_nodes(mesh.topology(), mirrored[static_cast<int>(mesh::first_order(mesh.element))]);
  const int n = mesh.topology().nodes;
  std::vector<int> before(n);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (!(mesh::least_jacobian(mesh, c) < 0)) continue;
    int* cell = &mesh.cells[static_cast<std::size_t>(c) * n];
    std::copy(cell, cell + n, before.begin());
    for (int k = 0; k < n; ++k) cell[k] = before[order[k]];
    if (!(mesh::least_jacobian(mesh, c) > 0)) std::copy(before.begin(), before.end(), cell);
  }
}

}  // namespace

mesh::Mesh mesh_of(const Contents& contents, const std::vector<const Block*>& blocks, int order, std::vector<int>& number, const std::string& what) {
  const mesh::Element first = element(contents, blocks, what);
  const mesh::ElementTopology& t = mesh::topology(order == 2 ? mesh::second_order(first) : first);
  Cells all = cells(blocks, t.corners, t.nodes - t.corners, static_cast<int>(contents.points.size() / 3));
  if (all.corners.size() + all.between.size() > 1'600'000'000) throw InputError(what + ": it has more cells than this program can number");
  if (t.dimension == 2) check_plane(contents, all, what);
  mesh::Mesh mesh = compact(contents, first, std::move(all.corners), number);
  // To tell which nodes cells share takes most.
  if (order == 2) require_memory(static_cast<double>(mesh.cell_count()) * (8 * t.nodes + 40 * (t.nodes - t.corners)), "cells of order 2 of '" + what + "'");
  if (order == 2) mesh = with_nodes_between(std::move(mesh), all.between, contents.points, number, what);
  turn_over(mesh);
  return mesh;
}

}  // namespace dotyk::meshfile
