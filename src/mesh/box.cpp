#include "mesh/generators.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::mesh {
namespace {

/// Corner (bit k set: upper end of axis k) to hexahedron node, VTK's order.
constexpr int kHexNode[8] = {0, 1, 3, 2, 4, 5, 7, 6};

/// The six paths 0 → 7 of the Kuhn cut as corner bits, each oriented positively.
constexpr int kKuhn[6][4] = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7},
                             {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};

/// Part names by axis and end.
constexpr const char* kPart[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};

/// Names the local facets of `cell` (corner bits of its nodes in `bits`) that lie on a side of the grid.
void name_facets(Mesh& mesh, int cell, const int* bits, const int at[3], const int cells[3]) {
  const ElementTopology& t = mesh.topology();
  for (int l = 0; l < t.facets; ++l)
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) {
        if (at[axis] != (end ? cells[axis] - 1 : 0)) continue;
        bool on = true;
        for (int k = 0; k < t.nodes_per_facet && on; ++k)
          on = ((bits[t.facet_nodes[l][k]] >> axis) & 1) == end;
        if (on) mesh.parts[kPart[axis][end]].push_back({cell, l});
      }
}

}  // namespace

Mesh box(const double from[3], const double to[3], const int cells[3], Family family,
         const Grading grading[3]) {
  const auto x = ticks(from[0], to[0], cells[0], grading[0], "x");
  const auto y = ticks(from[1], to[1], cells[1], grading[1], "y");
  const auto z = ticks(from[2], to[2], cells[2], grading[2], "z");
  Mesh mesh;
  mesh.element = simplices(family) ? Element::tetrahedron_p1 : Element::hexahedron_q1;
  mesh.coordinates.reserve(3 * x.size() * y.size() * z.size());
  for (double zk : z)
    for (double yj : y)
      for (double xi : x) mesh.coordinates.insert(mesh.coordinates.end(), {xi, yj, zk});
  const int stride[3] = {1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)};
  int hex_bits[8];
  for (int corner = 0; corner < 8; ++corner) hex_bits[kHexNode[corner]] = corner;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const int at[3] = {i, j, k};
        const int base = i * stride[0] + j * stride[1] + k * stride[2];
        const auto add = [&](const int* bits, int count) {
          for (int n = 0; n < count; ++n) {
            int node = base;
            for (int axis = 0; axis < 3; ++axis) node += ((bits[n] >> axis) & 1) * stride[axis];
            mesh.cells.push_back(node);
          }
          name_facets(mesh, mesh.cell_count() - 1, bits, at, cells);
        };
        if (simplices(family))
          for (const auto& path : kKuhn) add(path, 4);
        else
          add(hex_bits, 8);
      }
  return of_family(std::move(mesh), family);
}

}  // namespace dotyk::mesh
