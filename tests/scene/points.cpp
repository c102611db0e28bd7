#include <doctest/doctest.h>

#include "../support/random.hpp"
#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

Point linear(const Point& x) {
  return {0.01 * x[0] - 0.02 * x[1] + 0.01 * x[2], 0.03 * x[1], 0.01 * x[0] - 0.02 * x[2]};
}

}  // namespace

TEST_CASE("displacement and stress at points, of a linear displacement, are exact anywhere in the body") {
  test::Random random(401);
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      auto m = test::unit(dim, family, 4);
      test::distort(m, 0.04);
      const auto block = test::body("block", std::move(m));
      auto all = scene::chosen_part(block, "all", [](const Point&, const Point&) { return true; });
      std::array<elasticity::ScalarField, 3> u;
      for (int i = 0; i < dim; ++i) u[i] = [i](const Point& x) { return linear(x)[i]; };
      scene::displace(all, u);
      const auto s = test::solve(scene::make_scene({block}));
      const auto constant = s->stress(0)[0];
      for (int k = 0; k < 200; ++k) {
        Point x{0, 0, 0};
        for (int i = 0; i < dim; ++i) x[i] = k < 8 ? (k >> i & 1) : random.between(0, 1);  // corners first
        const Point v = s->displacement(0, x), exact = linear(x);
        for (int i = 0; i < dim; ++i) CHECK(std::abs(v[i] - exact[i]) < 1e-14);
        const auto stress = s->stress(0, x);
        for (int c = 0; c < 6; ++c) CHECK(std::abs(stress[c] - constant[c]) < 1e-11);
      }
      CHECK_THROWS_WITH_AS(s->displacement(0, {1.1, 0.5, 0.5}), doctest::Contains("lies outside 'block' at rest"),
                           InputError);
      CHECK_THROWS_AS(s->stress(0, {0.5, -0.01, 0.5}), InputError);
      CHECK_THROWS_AS(s->displacement(0, {NAN, 0.5, 0.5}), InputError);
    }
}

TEST_CASE("points in a disc are found, and in the hole of an L they are not") {
  for (const auto family : test::kFamilies) {
    const auto disc = test::body("disc", test::disc(family, 6));
    test::fix(disc, "boundary");
    const auto s = test::solve(scene::make_scene({disc}));
    for (double r : {0.0, 0.2, 0.5, 0.9, 0.98})
      for (double angle = 0; angle < 6.28; angle += 0.1)
        CHECK_NOTHROW(s->displacement(0, {r * std::cos(angle), r * std::sin(angle), 0}));
    CHECK_THROWS_AS(s->displacement(0, {0.8, 0.8, 0}), InputError);
    const auto frame = test::body(
        "frame", test::without(test::rectangle(family, 8, 8), [](const Point& x) { return x[0] > 0.5 && x[1] > 0.5; }));
    auto outer = scene::chosen_part(frame, "outer", [](const Point& x, const Point&) { return x[0] == 0; });
    scene::fix(outer, {true, true, true});
    const auto l = test::solve(scene::make_scene({frame}));
    CHECK_THROWS_AS(l->displacement(0, {0.75, 0.75, 0}), InputError);
    CHECK_NOTHROW(l->displacement(0, {0.5, 0.75, 0}));
  }
}
