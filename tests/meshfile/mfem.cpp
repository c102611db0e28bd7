#include "meshfile/mfem.hpp"

#include <doctest/doctest.h>

#include "base/error.hpp"
#include "meshfile/assemble.hpp"

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

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
  return text;
}

void check_refused(const std::string& text, const std::string& why) {
  try {
    assemble(read_mfem(text, "f.mesh"), {}, "f.mesh");
    FAIL_CHECK("not refused: " << why);
  } catch (const InputError& e) {
    CHECK_MESSAGE(std::string(e.what()).find(why) != std::string::npos, e.what());
  }
}

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
  check_refused("mesh", "its first line is 'mesh'; 'MFEM mesh v1.0' is expected");
  check_refused("MFEM mesh v1.0", "no cells");
  check_refused(replaced(kMesh, "v1.0", "v1.3"), "MFEM mesh v1.3");
  check_refused(replaced(kMesh, "\n2\n", "\n4\n"), "f.mesh, line 5: dimension 4; 2 or 3 is expected");
  check_refused(replaced(kMesh, "7 2 1 2 4", "7 2 1 x 4"), "line 9: 'x' where a vertex should be");
  check_refused(replaced(kMesh, "7 2 1 2 4", "7 2 1 2 6"), "has a node that is not there");
  check_refused(replaced(kMesh, "7 2 1 2 4", "7 5 1 2 4"), "hexahedra among elements of dimension 2");
  check_refused(replaced(kMesh, "7 2 1 2 4", "7 8 1 2 4"), "geometry type 8");
  check_refused(replaced(kMesh, "\n6\n", "\n2000000000\n"), "the file is too short for that");
  check_refused(replaced(kMesh, "\n6\n", "\n7\n"), "it ends where a coordinate should be");
  check_refused(replaced(kMesh, "\n6\n2\n", "\n6\nnodes\n"), "'FiniteElementSpace' should be");
  check_refused(replaced(kMesh, "boundary", "bindary"), "unknown section 'bindary'");
  for (std::size_t n = 0; n + 4 < kMesh.size(); n += 3) CHECK_THROWS_AS(assemble(read_mfem(kMesh.substr(0, n), "f"), {}, "f"), InputError);
}
