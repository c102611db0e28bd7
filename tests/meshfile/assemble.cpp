#include "meshfile/assemble.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "refused.hpp"

using namespace dotyk;
using namespace dotyk::meshfile;
using test::check_refused;

namespace {

/// Squares [i, i + 1] × [0, 1] with i < n in the plane z = 3, each a region of its own, "0", "1", …; a node off them.
Contents squares(int n) {
  Contents c;
  for (int i = 0; i <= n; ++i)
    for (const double y : {0., 1.}) c.points.insert(c.points.end(), {double(i), y, 3});
  c.points.insert(c.points.begin(), {9, 9, 9});
  for (int i = 0; i < n; ++i) {
    const int a = 1 + 2 * i;
    c.groups.push_back({2, std::to_string(i)});
    c.blocks.push_back({Shape::quadrilateral, {i}, {a, a + 2, a + 3, a + 1}});
  }
  return c;
}

void add_part(Contents& c, const std::string& name, std::vector<int> nodes) {
  c.groups.push_back({1, name});
  c.blocks.push_back({Shape::segment, {static_cast<int>(c.groups.size()) - 1}, std::move(nodes)});
}

double area(const mesh::Mesh& m) {
  double twice = 0;  // by Gauss: x·n over the boundary
  for (const mesh::Facet f : mesh::boundary(m)) {
    const mesh::Point x = m.facet_centre(f), n = m.facet_area_vector(f);
    twice += x[0] * n[0] + x[1] * n[1];
  }
  return twice / 2;
}

}  // namespace

TEST_CASE("all cells or those of some regions, without the nodes of others") {
  const Contents c = squares(3);
  const Loaded all = assemble(c, {}, "f");
  CHECK(all.mesh.node_count() == 8);
  CHECK(all.mesh.cell_count() == 3);
  CHECK(area(all.mesh) == doctest::Approx(3).epsilon(1e-14));
  CHECK(all.regions == std::vector<std::string>{"0", "1", "2"});
  const Loaded two = assemble(c, {.regions = {"2", "0"}}, "f");
  CHECK(two.mesh.node_count() == 8);
  CHECK(two.mesh.cell_count() == 2);
  CHECK(area(two.mesh) == doctest::Approx(2).epsilon(1e-14));
  CHECK(two.regions == std::vector<std::string>{"0", "2"});
  CHECK(assemble(c, {.regions = {"1"}}, "f").mesh.node_count() == 4);
}

TEST_CASE("facets of a part: those on the boundary of what is loaded, each once") {
  Contents c = squares(2);
  add_part(c, "left", {2, 1, 1, 2});
  add_part(c, "middle", {3, 4});
  add_part(c, "elsewhere", {1, 6});
  add_part(c, "mixed", {3, 4, 5, 6});
  const Loaded all = assemble(c, {}, "f");
  CHECK(all.mesh.parts.size() == 2);
  CHECK(all.mesh.parts.at("left") == std::vector<mesh::Facet>{{0, 3}});
  CHECK(all.mesh.parts.at("mixed") == std::vector<mesh::Facet>{{1, 1}});
  REQUIRE(all.notes.size() == 3);
  CHECK(all.notes[0] == "part 'elsewhere': 1 of its facets are of no cell and are left out, so there is no such part");
  CHECK(all.notes[1] == "part 'middle': 1 of its facets lie between cells and are left out, so there is no such part");
  CHECK(all.notes[2] == "part 'mixed': 1 of its facets lie between cells and are left out");
  const Loaded second = assemble(c, {.regions = {"1"}}, "f");  // what lay between is now on its boundary
  CHECK(second.mesh.parts.at("middle") == std::vector<mesh::Facet>{{0, 3}});
  CHECK(second.mesh.parts.count("left") == 0);
  CHECK(second.notes.empty());
}

TEST_CASE("clockwise cells are turned over, repeated ones count once") {
  Contents c = squares(3);
  std::swap(c.blocks[1].nodes[1], c.blocks[1].nodes[3]);
  c.blocks.push_back(c.blocks[2]);
  const Loaded all = assemble(c, {}, "f");
  CHECK(all.mesh.cell_count() == 3);
  for (int k = 0; k < 3; ++k) CHECK(mesh::least_jacobian(all.mesh, k) == doctest::Approx(1).epsilon(1e-14));
  // In space: left-handed tetrahedron and hexahedron.
  Contents solid;
  for (const double z : {0., 1.})
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) solid.points.insert(solid.points.end(), {x, y, -z});
  solid.blocks = {{Shape::hexahedron, {}, {0, 1, 2, 3, 4, 5, 6, 7}}};
  CHECK(mesh::least_jacobian(assemble(solid, {}, "f").mesh, 0) == doctest::Approx(1).epsilon(1e-14));
  solid.blocks = {{Shape::tetrahedron, {}, {0, 1, 3, 4}}};
  CHECK(mesh::least_jacobian(assemble(solid, {}, "f").mesh, 0) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("cells that lie on one side of their common facet overlap, whichever way round each is") {
  Contents c;
  c.points = {0, 0, 0, 1, 0, 0, 0.3, 1, 0, 0.6, 0.8, 0};
  for (const std::vector<int>& second : {std::vector{0, 1, 3}, std::vector{1, 0, 3}}) {
    c.blocks = {{Shape::triangle, {}, {0, 1, 2}}, {Shape::triangle, {}, second}};
    check_refused(c, {}, "cells 1 and 2 overlap: they lie on the same side of their common facet near (0.5, 0)");
  }
  c.points.insert(c.points.end(), {0.5, -1, 0});  // the third cell lies on the side of the first
  c.blocks = {{Shape::triangle, {}, {0, 1, 2, 1, 0, 4, 0, 1, 3}}};
  check_refused(c, {}, "overlap");
  Contents solid;
  solid.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.3, 0.3, 0.7};
  solid.blocks = {{Shape::tetrahedron, {}, {0, 1, 2, 3, 0, 2, 1, 4}}};
  check_refused(solid, {}, "cells 1 and 2 overlap");
  solid.points[14] = -0.7;
  CHECK(assemble(solid, {}, "f").mesh.cell_count() == 2);
  solid.points.insert(solid.points.end(), {0.3, 0.3, 0.5});  // the third cell lies on the side of the first
  solid.blocks = {{Shape::tetrahedron, {}, {0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5}}};
  check_refused(solid, {}, "cells 1 and 3 overlap");
}

TEST_CASE("hexahedra overlap if their common facet has two orders of its corners") {
  // A, B, C, D are the corners of a regular tetrahedron. Seen along z they are a square with the corners in the order A C D B, seen along x in the order A C B D.
  Contents c;
  c.points = {1, 1, 1, -1, 1, -1, -1, -1, 1, 1, -1, -1};                               // A, C, D, B
  c.points.insert(c.points.end(), {1, 1, 3, -1, 1, 3, -1, -1, 3, 1, -1, 3});           // above the first square, at z = 3
  c.points.insert(c.points.end(), {3, 1, 1, 3, 1, -1, 3, -1, -1, 3, -1, 1});           // beside the second one, at x = 3
  const std::vector<int> upper{0, 1, 2, 3, 4, 5, 6, 7}, right{0, 1, 3, 2, 8, 9, 10, 11};
  for (const auto& cell : {upper, right}) {
    c.blocks = {{Shape::hexahedron, {}, cell}};
    const mesh::Mesh alone = assemble(c, {}, "f").mesh;
    CHECK(mesh::least_jacobian(alone, 0) > 0);
  }
  c.blocks = {{Shape::hexahedron, {}, upper}, {Shape::hexahedron, {}, right}};
  check_refused(c, {}, "cells 1 and 2 overlap");
}

TEST_CASE("a plane mesh loses a constant z; a surface in space is refused") {
  Contents c = squares(2);
  CHECK(assemble(c, {}, "f").mesh.dimension() == 2);
  Contents turned = c;
  for (std::size_t i = 0; i < c.points.size(); i += 3) std::swap(turned.points[i + 1], turned.points[i + 2]);
  check_refused(turned, {}, "plane of constant y");
  c.points[5] += 1e-3;
  check_refused(c, {}, "surface in space");
}

TEST_CASE("what cannot be a mesh says why") {
  Contents c = squares(2);
  check_refused(c, {.regions = {"3"}}, "there is no region '3'; regions: '0', '1'");
  add_part(c, "left", {1, 2});
  check_refused(c, {.regions = {"left"}}, "there is no region 'left' (a boundary part has that name)");
  Contents mixed = c;
  mixed.groups.push_back({2, "t"});
  mixed.blocks.push_back({Shape::triangle, {static_cast<int>(mixed.groups.size()) - 1}, {5, 6, 0}});
  check_refused(mixed, {}, "of several (triangles in 't'; quadrilaterals in '0', '1')");
  CHECK(assemble(mixed, {.regions = {"0", "1"}}, "f").mesh.cell_count() == 2);
  Contents stray = c;
  stray.blocks[0].nodes[2] = 7;
  check_refused(stray, {}, "has a node that is not there");
  stray.blocks[0].nodes[2] = -1;
  check_refused(stray, {}, "has a node that is not there");
  Contents lines;
  add_part(lines, "a", {});
  check_refused(lines, {}, "it holds no cells");
  Contents prism;
  prism.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};
  prism.blocks = {{Shape::prism, {}, {0, 1, 2, 3, 4, 5}}};
  check_refused(prism, {}, "its cells are prisms");
  Contents nan = c;
  nan.points[3] = NAN;
  check_refused(nan, {}, "not finite");
  Contents twisted = c;
  std::swap(twisted.blocks[0].nodes[1], twisted.blocks[0].nodes[2]);
  check_refused(twisted, {}, "cell 1");
}
