#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::mesh {
namespace {

/// Where a cell of order 2 is bad and its corners make a good one of order 1: what to do about it.
std::string advice(const Mesh& mesh, int c) {
  const ElementTopology& t = mesh.topology();
  if (t.order == 1) return "check the order of nodes or the map of the mesh";
  Mesh straight;
  straight.element = first_order(mesh.element);
  for (int k = 0; k < t.corners; ++k) {
    straight.cells.push_back(k);
    straight.coordinates.insert(straight.coordinates.end(), mesh.node(mesh.cell(c)[k]), mesh.node(mesh.cell(c)[k]) + t.dimension);
  }
  return least_jacobian(straight, 0) > 0 ? "its sides are bent too far; with straight sides (order = 1) it is sound, finer cells are bent less"
                                         : "check the order of nodes or the map of the mesh";
}

double edge_scale(const Mesh& mesh, int c) {
  const Point a = mesh.point(mesh.cell(c)[0]);
  double h = 0;
  for (int k = 1; k < nodes_of(mesh.element); ++k) h = std::max(h, length(minus(mesh.point(mesh.cell(c)[k]), a)));
  return h;
}

void refuse_repeated_cells(const Mesh& mesh, const std::string& what) {
  // Two cells with the same nodes have the same centre's node sum and least node; compare those.
  const int n = mesh.topology().nodes;
  const Buckets by_least(mesh.node_count(), [&](auto&& put) {
    for (int c = 0; c < mesh.cell_count(); ++c) put(*std::min_element(mesh.cell(c), mesh.cell(c) + n), c);
  });
  for (int node = 0; node < mesh.node_count(); ++node)
    for (const int a : by_least[node])
      for (const int b : by_least[node])
        if (a < b && std::is_permutation(mesh.cell(a), mesh.cell(a) + n, mesh.cell(b)))
          throw InputError(text(what, ": cells ", a + 1, " and ", b + 1, " have the same nodes; remove one of them"));
}

void refuse_stray_nodes(const Mesh& mesh, const std::string& what) {
  const Buckets cells = cells_of_nodes(mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (cells[node].empty())
      throw InputError(text(what, ": node ", node + 1, " at ", point_text(mesh.node(node), mesh.dimension()), " belongs to no cell; remove it"));
}

/// Throws where a cell is flat, inverted, or of a size beyond the range of numbers.
void check_cell(const Mesh& mesh, int c, const std::string& what) {
  const double edge = edge_scale(mesh, c), scale = edge * edge * (mesh.dimension() == 2 ? 1 : edge);
  const double jacobian = least_jacobian(mesh, c);
  if (!std::isfinite(jacobian) || !std::isfinite(scale) || scale < std::numeric_limits<double>::min())
    throw InputError(text(what, ": cell ", c + 1, " is so ", std::isfinite(jacobian) && scale < 1 ? "small" : "large", " that its ", mesh.dimension() == 2 ? "area" : "volume",
                          " is beyond the range of numbers; choose another unit of length"));
  // A cell flatter than 1e-12 of its size has no digits left in its gradients.
  if (jacobian > 1e-12 * scale) return;
  const std::string cell = text(what, ": cell ", c + 1, " (a ", mesh.topology().shape, " near ", point_text(mesh.cell_centre(c).data(), mesh.dimension()), ")");
  if (jacobian < -1e-12 * scale)
    throw InputError(text(cell, " is inverted; its least Jacobian is ", jacobian, ", it must be positive: ", advice(mesh, c)));
  throw InputError(text(cell, " is flat: its least Jacobian, ", jacobian, ", is ", jacobian / scale, " of its extent ", mesh.dimension() == 2 ? "squared" : "cubed",
                        ", and must be more than 1e-12 of that: ", jacobian > 0 ? "take cells that are less slender" : advice(mesh, c)));
}

}  // namespace

void check(const Mesh& mesh, const std::string& what) {
  for (int i = 0; i < mesh.node_count(); ++i)
    for (int k = 0; k < mesh.dimension(); ++k)
      if (!std::isfinite(mesh.node(i)[k]))
        throw InputError(text(what, ": node ", i + 1, " has a coordinate that is not finite"));
  constexpr int kFew = 50'000;  // cells, for a thread
  parallel_ranges(mesh.cell_count(), threads_for(mesh.cell_count(), kFew), [&](int, int first, int end) {
    for (int c = first; c < end; ++c) check_cell(mesh, c, what);
  });
  if (mesh.one_piece()) return;  // by how it was made: no cell twice, no stray node
  refuse_repeated_cells(mesh, what);
  refuse_stray_nodes(mesh, what);
}

}  // namespace dotyk::mesh
