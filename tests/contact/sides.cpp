#include "contact/sides.hpp"

#include <doctest/doctest.h>

#include <map>

#include "../support/elastic.hpp"
#include "../support/facets.hpp"
#include "elasticity/load.hpp"

using namespace dotyk;
using contact::NodeSide;
using mesh::Point;

namespace {

double sum_of_weights(const std::vector<NodeSide>& list) {
  double sum = 0;
  for (const auto& n : list) sum += n.weight;
  return sum;
}

/// Sides at the node at x.
std::vector<NodeSide> at(const mesh::Mesh& m, const std::vector<NodeSide>& list, const Point& x) {
  std::vector<NodeSide> result;
  for (const auto& n : list)
    if (m.point(n.node) == x) result.push_back(n);
  return result;
}

}  // namespace

TEST_CASE("a broken line has two sides at its corner, with the edges' own normals and halves") {
  for (const auto family : test::kFamilies) {
    // An L: the square without its upper right quarter; the part is the re-entrant corner's two legs.
    const auto m =
        test::without(test::rectangle(family, 8, 8), [](const Point& x) { return x[0] > 0.5 && x[1] > 0.5; });
    const auto legs = mesh::select(
        m, [](const Point& x, const Point&) { return (x[0] == 0.5 && x[1] > 0.5) || (x[1] == 0.5 && x[0] > 0.5); });
    const auto sides = contact::sides(m, legs);
    CHECK(sides.size() == 4 + 4 + 2);
    CHECK(sum_of_weights(sides) == doctest::Approx(1).epsilon(1e-14));
    const auto corner = at(m, sides, {0.5, 0.5, 0});
    REQUIRE(corner.size() == 2);
    for (const auto& s : corner) {
      CHECK(s.weight == doctest::Approx(1.0 / 16));
      CHECK(std::max(s.normal[0], s.normal[1]) == doctest::Approx(1));
      CHECK(s.normal[0] * s.normal[1] == 0);
    }
    CHECK(corner[0].normal[0] != corner[1].normal[0]);
    // Without sides there is one entry a node, the corner's normal between.
    const auto nodes = contact::nodes(m, legs);
    CHECK(nodes.size() == 9);
    const auto one = at(m, nodes, {0.5, 0.5, 0});
    REQUIRE(one.size() == 1);
    CHECK(one[0].normal[0] == doctest::Approx(std::sqrt(0.5)));
    CHECK(one[0].weight == doctest::Approx(1.0 / 8));
  }
}

TEST_CASE("a cube has three sides at a corner, two at an edge, one on a face") {
  for (const auto family : test::kFamilies) {
    const auto m = test::box(family, 2, 2, 2);
    const auto sides = contact::sides(m, mesh::boundary(m));
    CHECK(sum_of_weights(sides) == doctest::Approx(6).epsilon(1e-14));
    std::map<int, int> count;
    for (const auto& s : sides) {
      ++count[s.node];
      CHECK(std::abs(s.normal[0]) + std::abs(s.normal[1]) + std::abs(s.normal[2]) == doctest::Approx(1));
    }
    for (const auto& [node, sides_there] : count) {
      int faces = 0;
      for (double v : m.point(node)) faces += v == 0 || v == 1;
      CHECK(sides_there == faces);
    }
  }
}

TEST_CASE("a circle of 12 edges and more is smooth, with radial normals") {
  for (const auto family : test::kFamilies)
    for (int cells : {3, 4, 8}) {
      const auto m = test::disc(family, cells, 2, 1);
      const auto& circle = m.parts.at("boundary");
      const auto sides = contact::sides(m, circle);
      CHECK(sides.size() == circle.size());
      CHECK(sum_of_weights(sides) == doctest::Approx(test::measure(m, circle)).epsilon(1e-14));
      for (const auto& s : sides) {
        CHECK(s.normal[0] == doctest::Approx(m.node(s.node)[0] - 2));
        CHECK(s.normal[1] == doctest::Approx(m.node(s.node)[1] - 1));
      }
    }
  CHECK(contact::sides(test::disc(mesh::Family::p1, 2), test::disc(mesh::Family::p1, 2).parts.at("boundary")).size() ==
        12);
  // Six edges of 60° are corners.
  CHECK(contact::sides(test::disc(mesh::Family::p1, 1), test::disc(mesh::Family::p1, 1).parts.at("boundary")).size() ==
        12);
}

TEST_CASE("weights of a face: constant pressure has the nodal forces of the traction") {
  for (const auto family : test::kFamilies) {
    const auto m = test::box(family, 3, 2, 2);
    const auto& top = m.parts.at("top");
    std::vector<double> force(m.coordinates.size(), 0);
    test::add_pressure(
        m, top, 1, force);
    for (const auto& s : contact::sides(m, top))
      CHECK(s.weight == doctest::Approx(-force[3 * s.node + 2]).epsilon(1e-14));
  }
}
