#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "mfem_text.hpp"

using namespace dotyk;
using namespace dotyk::meshfile;

namespace {

using mesh::Point;
using Corners = std::vector<int>;

/// Local edges and faces of MFEM's geometries; a square's face is itself.
struct Geometry {
  int type, dimension;
  std::vector<Corners> edges, faces;
  bool inside;
};
const Geometry kTriangle{2, 2, {{0, 1}, {1, 2}, {2, 0}}, {}, false};
const Geometry kSquare{3, 2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}, true};
const Geometry kTetrahedron{4, 3, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}, {}, false};
const Geometry kCube{5,
                     3,
                     {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
                     {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}},
                     true};

/// Bends a straight mesh.
Point bent(const Point& x) { return {x[0] + 0.1 * x[1] * x[1], x[1] - 0.07 * x[0] * x[0], x[2] + 0.05 * x[0] * x[1] + 0.03 * x[2] * x[2]}; }

/// A file of order 2 with nodes in the bent middles, numbered as MFEM does: vertices, edges and faces as they come, cells.
std::string file(const Geometry& g, const std::vector<Point>& vertices, const std::vector<Corners>& elements, int ordering) {
  std::ostringstream out;
  out.precision(17);
  out << "MFEM mesh v1.0\ndimension\n" << g.dimension << "\nelements\n" << elements.size() << "\n";
  std::vector<Corners> nodes;
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v) nodes.push_back({v});
  for (const std::vector<Corners>* local : {&g.edges, &g.faces})
    for (const Corners& e : elements)
      for (const Corners& own : *local) {
        Corners all;
        for (const int k : own) all.push_back(e[k]);
        std::sort(all.begin(), all.end());
        if (std::find(nodes.begin(), nodes.end(), all) == nodes.end()) nodes.push_back(all);
      }
  for (const Corners& e : elements) {
    out << "1 " << g.type;
    for (const int v : e) out << " " << v;
    out << "\n";
    if (g.inside) nodes.push_back(e);
  }
  out << "boundary\n0\nvertices\n" << vertices.size() << "\nnodes\nFiniteElementSpace\nFiniteElementCollection: "
      << (ordering == 0 ? "Quadratic" : g.dimension == 2 ? "H1_2D_P2" : "H1_3D_P2") << "\nVDim: " << g.dimension << "\nOrdering: " << ordering << "\n";
  const auto value = [&](std::size_t n, int i) {
    Point mean{0, 0, 0};
    for (const int v : nodes[n])
      for (int j = 0; j < 3; ++j) mean[j] += vertices[v][j] / static_cast<double>(nodes[n].size());
    return bent(mean)[i];
  };
  if (ordering == 0)
    for (int i = 0; i < g.dimension; ++i)
      for (std::size_t n = 0; n < nodes.size(); ++n) out << value(n, i) << "\n";
  else
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int i = 0; i < g.dimension; ++i) out << value(n, i) << "\n";
  return out.str();
}

/// Every node of the mesh read is the bent mean of its cell's corners.
void check_read(const Geometry& g, const std::vector<Point>& vertices, const std::vector<Corners>& elements, int nodes) {
  for (const int ordering : {0, 1}) {
    const std::string text = file(g, vertices, elements, ordering);
    const mesh::Mesh m = assemble(read_mfem(text, "f"), {.order = 2}, "f").mesh;
    REQUIRE(m.cell_count() == static_cast<int>(elements.size()));
    CHECK(m.node_count() == nodes);
    const mesh::ElementTopology& t = m.topology();
    for (int c = 0; c < m.cell_count(); ++c)
      for (int k = 0; k < t.nodes; ++k) {
        const Corners own = k < t.corners ? Corners{k} : t.between[k - t.corners];
        Point mean{0, 0, 0};
        for (const int corner : own)
          for (int j = 0; j < 3; ++j) mean[j] += vertices[elements[c][corner]][j] / static_cast<double>(own.size());
        for (int i = 0; i < g.dimension; ++i) CHECK(m.node(m.cell(c)[k])[i] == doctest::Approx(bent(mean)[i]).epsilon(1e-14));
      }
    const Loaded first = assemble(read_mfem(text, "f"), {}, "f");
    CHECK(first.mesh.node_count() == static_cast<int>(vertices.size()));
    CHECK(first.notes.size() == 1);
  }
}

const std::vector<Point> kPlane{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};

}  // namespace

TEST_CASE("MFEM's curved meshes of order 2: nodes on edges, in faces and in cells") {
  check_read(kSquare, kPlane, {{0, 1, 4, 3}, {1, 2, 5, 4}}, 15);
  check_read(kTriangle, kPlane, {{0, 1, 4}, {4, 3, 0}, {1, 2, 5}, {5, 4, 1}}, 15);
  std::vector<Point> solid = kPlane;
  for (const Point& x : kPlane) solid.push_back({x[0], x[1], 1});
  check_read(kCube, solid, {{0, 1, 4, 3, 6, 7, 10, 9}, {1, 2, 5, 4, 7, 8, 11, 10}}, 45);
  check_read(kTetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {4, 1, 3, 2}}, 5 + 9);
}

TEST_CASE("MFEM's curved meshes: what is wrong with the nodes, and in which line") {
  const std::string sound = file(kSquare, kPlane, {{0, 1, 4, 3}, {1, 2, 5, 4}}, 1);
  const auto refused = [&](const std::string& text, const std::string& why) { test::refused(text, why, {.order = 2}); };
  refused(test::replaced(sound, "H1_2D_P2", "H1_2D_P3"), "line 14: nodes by the collection 'H1_2D_P3'; 'Linear', 'Quadratic' and");
  refused(test::replaced(sound, "H1_2D_P2", "L2_T1_2D_P2"), "'L2_T1_2D_P2'");
  refused(test::replaced(sound, "VDim: 2", "VDim: 1"), "nodes of dimension 1; 2 or 3 is expected");
  refused(test::replaced(sound, "VDim:", "VDims"), "'VDims' where 'VDim:' should be");
  refused(test::replaced(sound, "Ordering: 1", "Ordering: 2"), "ordering 2; 0 or 1 is expected");
  refused(test::replaced(sound, "1 3 0 1 4 3", "1 3 0 1 6 3"), "vertex 6 of an element; there are 6, counted from 0");
  refused(test::replaced(sound, "1 3 0 1 4 3", "1 3 0 1 -1 3"), "vertex -1 of an element");
  refused(sound.substr(0, sound.size() - 25), "it ends where a coordinate should be");
  refused(sound + "vertices\n6\nnodes\nFiniteElementSpace\nFiniteElementCollection: Quadratic\nVDim: 2\nOrdering: 1\n" + std::string(100, '0'), "");
  for (std::size_t n = 0; n + 20 < sound.size(); n += 7) CHECK_THROWS_AS(assemble(read_mfem(sound.substr(0, n), "f"), {.order = 2}, "f"), InputError);
}
