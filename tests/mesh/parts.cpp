#include <doctest/doctest.h>

#include "../support/meshes.hpp"

using namespace dotyk;

namespace {

struct Side {
  const char* name;
  mesh::Point normal;
  double measure;
};

void check_sides(const mesh::Mesh& m, const std::vector<Side>& sides) {
  std::size_t facets = 0;
  for (const Side& side : sides) {
    const auto& part = m.parts.at(side.name);
    facets += part.size();
    CHECK(test::measure(m, part) == doctest::Approx(side.measure).epsilon(1e-14));
    for (const auto f : part) {
      auto n = m.facet_area_vector(f);
      const double area = test::length(n);
      for (int i = 0; i < 3; ++i) CHECK(n[i] / area == doctest::Approx(side.normal[i]));
    }
    const auto chosen = mesh::select(m, [&](const mesh::Point&, const mesh::Point& n) {
      return n[0] * side.normal[0] + n[1] * side.normal[1] + n[2] * side.normal[2] > 0.99;
    });
    CHECK(chosen.size() == part.size());
  }
  CHECK(m.parts.size() == sides.size());
  CHECK(mesh::boundary(m).size() == facets);
}

}  // namespace

TEST_CASE("parts of a rectangle: outward normals, lengths, all of the boundary") {
  for (const auto family : test::kAllFamilies)
    check_sides(test::rectangle(family, 4, 7, -1, 0, 2, 5),
                {{"left", {-1, 0, 0}, 5}, {"right", {1, 0, 0}, 5}, {"bottom", {0, -1, 0}, 3}, {"top", {0, 1, 0}, 3}});
}

TEST_CASE("parts of a box: outward normals, areas, all of the boundary") {
  for (const auto family : test::kAllFamilies)
    check_sides(test::box(family, 2, 3, 4, {0, 0, 0}, {1, 2, 3}), {{"left", {-1, 0, 0}, 6},
                                                                   {"right", {1, 0, 0}, 6},
                                                                   {"front", {0, -1, 0}, 3},
                                                                   {"back", {0, 1, 0}, 3},
                                                                   {"bottom", {0, 0, -1}, 2},
                                                                   {"top", {0, 0, 1}, 2}});
}

TEST_CASE("numbers of boundary facets") {
  CHECK(mesh::boundary(test::rectangle(mesh::Family::p1, 4, 3)).size() == 14);
  CHECK(mesh::boundary(test::rectangle(mesh::Family::q1, 4, 3)).size() == 14);
  CHECK(mesh::boundary(test::box(mesh::Family::p1, 2, 3, 4)).size() == 2 * 2 * (6 + 8 + 12));
  CHECK(mesh::boundary(test::box(mesh::Family::q1, 2, 3, 4)).size() == 2 * (6 + 8 + 12));
  CHECK(mesh::boundary(test::box(mesh::Family::q1, 1, 1, 1)).size() == 6);
}

TEST_CASE("select sees centres and unit normals of the boundary only") {
  const auto m = test::rectangle(mesh::Family::p1, 4, 4);
  const auto half = mesh::select(m, [](const mesh::Point& x, const mesh::Point& n) {
    CHECK(test::length(n) == doctest::Approx(1));
    return x[1] == 1 && x[0] < 0.5;
  });
  CHECK(half.size() == 2);
  CHECK(mesh::select(m, [](const mesh::Point&, const mesh::Point&) { return false; }).empty());
}
