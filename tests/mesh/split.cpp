#include <doctest/doctest.h>

#include <set>

#include "mesh/generators.hpp"
#include "mesh/decomposition.hpp"

using namespace dotyk::mesh;

namespace {

/// Centres of the facets of all parts, by name.
std::multiset<std::pair<std::string, Point>> centres(const Mesh& mesh) {
  std::multiset<std::pair<std::string, Point>> result;
  for (const auto& [name, facets] : mesh.parts)
    for (const Facet f : facets) result.emplace(name, mesh.facet_centre(f));
  return result;
}

}  // namespace

TEST_CASE("pieces connected through facets, with their shares of the boundary parts") {
  const double from[2] = {0, 0}, to[2] = {3, 2};
  const int cells[2] = {3, 2};
  for (const Family family : {Family::p1, Family::q1}) {
    const Mesh whole = rectangle(from, to, cells, family, std::array<Grading, 2>().data());
    CHECK(split(whole).size() == 1);
    // Two columns apart.
    const Mesh apart = keep(whole, [](const Point& x) { return x[0] < 1 || x[0] > 2; }, "cut");
    const std::vector<Mesh> pieces = split(apart);
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].cell_count() + pieces[1].cell_count() == apart.cell_count());
    CHECK(pieces[0].node_count() + pieces[1].node_count() == apart.node_count());
    auto together = centres(pieces[0]);
    together.merge(centres(pieces[1]));
    CHECK(together == centres(apart));
    CHECK(pieces[0].parts.count("left") == 1);
    CHECK(pieces[0].parts.count("right") == 0);
    CHECK(pieces[1].parts.count("left") == 0);
    CHECK(pieces[1].parts.at("cut").size() == 2);
    for (const Mesh& piece : pieces) check(piece, "piece");
    // Squares hinged at a corner are two pieces.
    CHECK(split(keep(whole, [](const Point& x) { return (x[0] < 1) == (x[1] < 1) && x[0] < 2; }, "cut")).size() == 2);
  }
}
