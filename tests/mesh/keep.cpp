#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("cells kept are a mesh of their own, with what is left of the parts and the facets laid bare") {
  for (const int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      const auto whole = test::unit(dim, family, 4);
      const auto corner_off = [](const mesh::Point& x) { return x[0] < 0.5 || x[1] < 0.5; };
      const auto kept = mesh::keep(whole, corner_off, "step");
      CHECK_NOTHROW(mesh::check(kept, "kept"));
      CHECK(test::measure(kept) == doctest::Approx(0.75).epsilon(1e-13));
      // The step has two sides of half the width, and as many facets are left of the sides it touched.
      const auto area = [&](const mesh::Mesh& mesh, const char* part) { return test::measure(mesh, mesh.parts.at(part)); };
      CHECK(area(kept, "step") == doctest::Approx(1).epsilon(1e-13));
      CHECK(area(kept, "left") == doctest::Approx(1).epsilon(1e-13));
      CHECK(area(kept, "right") == doctest::Approx(0.5).epsilon(1e-13));
      std::size_t facets = 0;
      for (const auto& [name, part] : kept.parts) facets += part.size();
      CHECK(facets == mesh::boundary(kept).size());
    }
}

TEST_CASE("nothing kept is refused, everything kept lays nothing bare") {
  const auto whole = test::rectangle(mesh::Family::q1, 3, 2);
  CHECK_THROWS_WITH_AS(mesh::keep(whole, [](const mesh::Point&) { return false; }, "cut"), doctest::Contains("no cell is kept"),
                       InputError);
  const auto all = mesh::keep(whole, [](const mesh::Point&) { return true; }, "cut");
  CHECK(all.coordinates == whole.coordinates);
  CHECK(all.cells == whole.cells);
  CHECK(all.parts == whole.parts);
}
