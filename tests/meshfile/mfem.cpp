#include "meshfile/formats.hpp"

#include <doctest/doctest.h>

#include "mfem_text.hpp"

using namespace dotyk;
using namespace dotyk::meshfile;

namespace {

// [0, 2] × [0, 1]: a square and two triangles beside it.
const std::string kMesh = R"(MFEM mesh v1.0

# a comment
dimension
2
elements   # three
3
4 3 0 1 4 3
7 2 1 2 4
7 2 2 5 4
boundary
2
1 1 0 1
30 1 2 5
vertices
6
2
0 0
1 0
2 0
0 1
1 1
2 1e0
)";

}  // namespace

TEST_CASE("MFEM's text: attributes become regions and parts") {
  const Loaded square = assemble(read_mfem(kMesh, "f"), {.regions = {"4"}}, "f");
  CHECK(square.mesh.element == mesh::Element::quadrilateral_q1);
  CHECK(square.mesh.node_count() == 4);
  CHECK(square.mesh.parts.at("1") == std::vector<mesh::Facet>{{0, 0}});
  CHECK(square.mesh.parts.count("30") == 0);
  const Loaded triangles = assemble(read_mfem(kMesh, "f"), {.regions = {"7"}}, "f");
  CHECK(triangles.mesh.cell_count() == 2);
  CHECK(triangles.mesh.parts.at("30") == std::vector<mesh::Facet>{{1, 0}});
  std::string windows;
  for (const char c : kMesh) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(assemble(read_mfem(windows, "f"), {.regions = {"7"}}, "f").mesh.coordinates == triangles.mesh.coordinates);
}

TEST_CASE("MFEM's text: what is wrong, and in which line") {
  test::refused("mesh", "its first line is 'mesh'; 'MFEM mesh v1.0' is expected");
  test::refused("MFEM mesh v1.0", "no cells");
  test::refused(test::replaced(kMesh, "v1.0", "v1.3"), "MFEM mesh v1.3");
  test::refused(test::replaced(kMesh, "\n2\n", "\n4\n"), "f.mesh, line 5: dimension 4; 2 or 3 is expected");
  test::refused(test::replaced(kMesh, "7 2 1 2 4", "7 2 1 x 4"), "line 9: 'x' where a vertex should be");
  test::refused(test::replaced(kMesh, "7 2 1 2 4", "7 2 1 2 6"), "has a node that is not there");
  test::refused(test::replaced(kMesh, "7 2 1 2 4", "7 5 1 2 4"), "hexahedra among elements of dimension 2");
  test::refused(test::replaced(kMesh, "7 2 1 2 4", "7 8 1 2 4"), "geometry type 8");
  test::refused(test::replaced(kMesh, "\n6\n", "\n2000000000\n"), "the file is too short for that");
  test::refused(test::replaced(kMesh, "\n6\n", "\n7\n"), "it ends where a coordinate should be");
  test::refused(test::replaced(kMesh, "\n6\n2\n", "\n6\nnodes\n"), "'FiniteElementSpace' should be");
  test::refused(test::replaced(kMesh, "boundary", "bindary"), "unknown section 'bindary'");
  for (std::size_t n = 0; n + 4 < kMesh.size(); n += 3) CHECK_THROWS_AS(assemble(read_mfem(kMesh.substr(0, n), "f"), {}, "f"), InputError);
}
