#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

std::shared_ptr<scene::Body> heavy(const std::string& name, mesh::Mesh m) {
  const int dim = m.dimension();
  return scene::make_body(name, std::make_shared<const mesh::Mesh>(std::move(m)),
                          elasticity::MaterialField(elasticity::isotropic(20, 0.3, dim, elasticity::Plane::strain)),
                          [](const Point& x) {
                            return Point{0.3, -1 - x[0], 0.2};
                          });
}

Point shear(const Point& x) { return {0.5 * x[1], 0.1, 0.3}; }

mesh::Mesh half(int dim, mesh::Family family, double lift) {
  mesh::Mesh m = dim == 2 ? test::rectangle(family, 4, 3, 0, 0, 1, 1) : test::box(family, 3, 2, 2);
  mesh::transform(m, [&](Point x) { return x[dim - 1] += lift, x; });
  return m;
}

}  // namespace

TEST_CASE("two glued halves are one body") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool reduced : {true, false}) {
        const auto whole = heavy("whole", dim == 2 ? test::rectangle(family, 4, 6, 0, 0, 1, 2)
                                                   : test::box(family, 3, 2, 4, {0, 0, 0}, {1, 1, 2}));
        test::fix(whole, "bottom");
        test::pull(whole, "top", shear);
        Monitor quiet;
        const auto one = scene::solve(scene::make_scene({whole}), {}, {}, quiet);

        const auto low = heavy("low", half(dim, family, 0)), high = heavy("high", half(dim, family, 1));
        test::fix(low, "bottom");
        test::pull(high, "top", shear);
        const auto scene = scene::make_scene({low, high});
        scene::add_glue(*scene, test::part(low, "top"), test::part(high, "bottom"));
        const auto two = test::solve(scene, reduced);
        REQUIRE_MESSAGE(two->result().converged, two->result().reason);
        double size = 0;
        for (double v : one->displacement(0)) size = std::max(size, std::abs(v));
        for (int b : {0, 1})
          for (int n = 0; n < scene->bodies[b]->mesh->node_count(); ++n) {
            const Point u = one->displacement(0, scene->bodies[b]->mesh->point(n));
            for (int i = 0; i < dim; ++i) CHECK(std::abs(two->displacement(b)[n * dim + i] - u[i]) < 1e-10 * size);
          }
        CHECK(std::abs(two->energy() - one->energy()) < 1e-10 * std::abs(one->energy()));
        // The glued half has no contact result, and says so.
        CHECK_THROWS_WITH_AS(two->contact(*scene->contacts[0]), doctest::Contains("is a glue"), InputError);
      }
}

TEST_CASE("glued parts that are prescribed different displacements are refused") {
  const auto low = heavy("low", half(2, mesh::Family::p1, 0)), high = heavy("high", half(2, mesh::Family::p1, 1));
  test::fix(low, "top");
  auto bottom = test::part(high, "bottom");
  scene::displace(bottom, {[](const Point&) { return 0.1; }, nullptr, nullptr});
  const auto scene = scene::make_scene({low, high});
  scene::add_glue(*scene, test::part(low, "top"), test::part(high, "bottom"));
  CHECK_THROWS_WITH_AS(test::solve(scene),
                       doctest::Contains("the two sides are prescribed displacements that differ by 0.1"), InputError);
}
