#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"
#include "mesh/decomposition.hpp"
#include "mesh/second_order.hpp"

using namespace dotyk;

namespace {

std::vector<mesh::Mesh> all_elements() {
  std::vector<mesh::Mesh> meshes;
  for (const auto family : test::kAllFamilies) {
    meshes.push_back(test::rectangle(family, 2, 2));
    meshes.push_back(test::box(family, 2, 2, 2));
  }
  return meshes;
}

}  // namespace

TEST_CASE("an inverted cell is refused with its number, shape and place") {
  for (auto m : all_elements()) {
    std::swap(m.cells[0], m.cells[1]);
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains("gear: cell 1 (a "), InputError);
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains(m.topology().shape), InputError);
  }
  auto triangles = test::rectangle(mesh::Family::p1, 1, 1);
  std::swap(triangles.cells[4], triangles.cells[5]);
  CHECK_THROWS_WITH_AS(mesh::check(triangles, "plate"),
                       doctest::Contains("plate: cell 2 (a triangle near (0.333333, 0.666667)) is inverted"),
                       InputError);
}

TEST_CASE("a flat cell is refused as flat") {
  for (auto m : all_elements()) {
    for (std::size_t k = 0; k < m.coordinates.size(); k += m.dimension()) m.coordinates[k] = 0.5;
    CHECK_THROWS_WITH_AS(mesh::check(m, "m"), doctest::Contains("is flat"), InputError);
  }
}

TEST_CASE("a cell that is flat for its size is told how flat, though its Jacobian is large") {
  const auto m = test::rectangle(mesh::Family::q1, 9, 1, 0, 0, 1e13, 1);
  CHECK_THROWS_WITH_AS(mesh::check(m, "m"),
                       "m: cell 1 (a quadrilateral near (5.55556e+11, 0.5)) is flat: its least Jacobian, 1.11111e+12, is 9e-13 of its extent squared, and must be "
                       "more than 1e-12 of that: take cells that are less slender", InputError);
}

TEST_CASE("slender cells are no flat ones") {
  for (const auto family : test::kAllFamilies) {
    CHECK_NOTHROW(mesh::check(test::rectangle(family, 2, 2, 0, 0, 1, 1e-9), "m"));
    CHECK_NOTHROW(mesh::check(test::rectangle(family, 2, 2, 0, 0, 1e-7, 1e-7), "m"));
    CHECK_NOTHROW(mesh::check(test::box(family, 1, 1, 1, {0, 0, 0}, {1, 1, 1e-9}), "m"));
  }
}

TEST_CASE("a quadrilateral with a corner beyond 180 degrees is refused") {
  auto m = test::rectangle(mesh::Family::q1, 1, 1);
  m.coordinates[6] = m.coordinates[7] = 0.4;
  CHECK_THROWS_WITH_AS(mesh::check(m, "m"), doctest::Contains("inverted"), InputError);
}

TEST_CASE("a cell given twice is refused, in any order of its nodes") {
  for (auto m : all_elements()) {
    const int n = m.topology().nodes;
    std::vector<int> again(m.cells.begin() + n, m.cells.begin() + 2 * n);
    if (m.element == mesh::Element::triangle_p1) std::rotate(again.begin(), again.begin() + 1, again.end());
    m.cells.insert(m.cells.end(), again.begin(), again.end());
    CHECK_THROWS_WITH_AS(mesh::check(m, "m"), doctest::Contains("have the same nodes"), InputError);
  }
}

TEST_CASE("a coordinate that is no number is refused with its node") {
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    auto m = test::rectangle(mesh::Family::p1, 2, 2);
    m.coordinates[7] = bad;
    CHECK_THROWS_WITH_AS(mesh::check(m, "m"), "m: node 4 has a coordinate that is not finite", InputError);
  }
}

TEST_CASE("a hexahedron that is inverted or flat between sound corners is refused, as of either order") {
  const auto with_corners = [](const double x[8][3]) {
    auto m = test::box(mesh::Family::q1, 1, 1, 1);
    for (int k = 0; k < 8; ++k) std::copy_n(x[k], 3, &m.coordinates[3 * static_cast<std::size_t>(m.cell(0)[k])]);
    return m;
  };
  const auto refused = [](const mesh::Mesh& m, const char* message) {
    CHECK_THROWS_WITH_AS(mesh::check(m, "m"), doctest::Contains(message), InputError);
    CHECK_THROWS_WITH_AS(mesh::check(mesh::second_order(m), "m"), doctest::Contains(message), InputError);
  };
  // Its top turned by half a turn: a point at mid-height.
  const double twisted[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
  refused(with_corners(twisted), "is flat: its least Jacobian, 0,");
  // At its corners 0.188 and more, in the middle of an edge -1.485.
  const double bent[8][3] = {{-0.9, 0.1, -0.7}, {1.5, -0.8, 0}, {1, 1.2, -0.6}, {-0.9, 1.9, -0.3}, {0.7, 0.4, 0.3}, {1.6, 0.6, 1.9}, {1.1, 1.1, 0.5}, {-0.1, 0.2, 1.9}};
  refused(with_corners(bent), "is inverted; its least Jacobian is -1.485, it must be positive: check the order of nodes");
}

TEST_CASE("straight hexahedra have the least Jacobian of the same ones of order 2") {
  for (const double by : {0.05, 0.1, 0.15}) {
    auto m = test::box(mesh::Family::q1, 4, 4, 4);
    test::distort(m, by);
    const mesh::Mesh second = mesh::second_order(m);
    for (int c = 0; c < m.cell_count(); ++c) CHECK(std::abs(mesh::least_jacobian(m, c) - mesh::least_jacobian(second, c)) < 1e-14);
  }
}

TEST_CASE("least Jacobians: twice the area, six times the volume, corners") {
  CHECK(mesh::least_jacobian(test::rectangle(mesh::Family::p1, 1, 1), 0) == 1);
  CHECK(mesh::least_jacobian(test::rectangle(mesh::Family::q1, 1, 1), 0) == 1);
  for (int c = 0; c < 6; ++c) CHECK(mesh::least_jacobian(test::box(mesh::Family::p1, 1, 1, 1), c) == 1);
  CHECK(mesh::least_jacobian(test::box(mesh::Family::q1, 1, 1, 1), 0) == 1);
}

TEST_CASE("grids, and what is made of their cells, are known to be in one piece; other meshes are not") {
  for (mesh::Mesh m : all_elements()) {
    CHECK(m.one_piece());
    CHECK(mesh::pieces_of(m).count == 1);
    const mesh::Mesh cut = mesh::cut_at_nodes(mesh::second_order(m));
    CHECK(cut.one_piece());
    CHECK(mesh::pieces_of(cut).count == 1);
    const mesh::Submesh half = mesh::submesh(m, {0});
    CHECK_FALSE(half.mesh.one_piece());
    m.cells.insert(m.cells.end(), m.cell(0), m.cell(0) + m.topology().nodes);
    CHECK_FALSE(m.one_piece());
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains("have the same nodes"), InputError);
  }
}

TEST_CASE("a node that belongs to no cell is refused with its number and place") {
  for (auto m : all_elements()) {
    const int node = m.node_count();
    for (int k = 0; k < m.dimension(); ++k) m.coordinates.push_back(7);
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains(("gear: node " + std::to_string(node + 1) + " at (7, 7").c_str()), InputError);
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains("belongs to no cell"), InputError);
  }
}
