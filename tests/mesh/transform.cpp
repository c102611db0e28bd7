#include <doctest/doctest.h>

#include <stdexcept>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("a transform moves every node and keeps the cells") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, 3);
      // A shear keeps the measure, a stretch multiplies it.
      mesh::transform(m, [](const mesh::Point& x) {
        return mesh::Point{2 * x[0] + 0.7 * x[1], x[1], x[2] - 0.3 * x[0]};
      });
      CHECK(test::measure(m) == doctest::Approx(2).epsilon(1e-13));
    }
}

TEST_CASE("a transform that inverts cells or gives no number is refused and undone") {
  for (const auto family : test::kAllFamilies) {
    auto m = test::rectangle(family, 4, 4);
    const auto before = m.coordinates;
    const auto mirror = [](const mesh::Point& x) { return mesh::Point{-x[0], x[1], 0}; };
    CHECK_THROWS_WITH_AS(mesh::transform(m, mirror), doctest::Contains(": cell 1 (a "), InputError);
    CHECK(m.coordinates == before);
    CHECK_THROWS_AS(mesh::transform(m, [](const mesh::Point& x) { return mesh::Point{x[0], NAN, 0}; }), InputError);
    CHECK(m.coordinates == before);
    int calls = 0;
    CHECK_THROWS_AS(mesh::transform(m,
                                    [&](const mesh::Point&) -> mesh::Point {
                                      if (++calls == 5) throw std::runtime_error("from the user's function");
                                      return {9, 9, 9};
                                    }),
                    std::runtime_error);
    CHECK(m.coordinates == before);
  }
}
