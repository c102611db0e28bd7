#include <doctest/doctest.h>

#include "../support/elastic.hpp"

using namespace dotyk;
using elasticity::Stress;

TEST_CASE("von Mises stress: uniaxial, hydrostatic, pure shear") {
  CHECK(elasticity::von_mises({7, 0, 0, 0, 0, 0}) == doctest::Approx(7));
  CHECK(elasticity::von_mises({-7, 0, 0, 0, 0, 0}) == doctest::Approx(7));
  CHECK(elasticity::von_mises({5, 5, 5, 0, 0, 0}) == 0);
  for (int v : {3, 4, 5}) {
    Stress s{};
    s[v] = 2;
    CHECK(elasticity::von_mises(s) == doctest::Approx(2 * std::sqrt(3.0)));
  }
}

TEST_CASE("principal stresses: sorted, invariants kept, and von Mises from them") {
  test::Random random(221);
  CHECK(elasticity::principal({1, 3, 2, 0, 0, 0}) == std::array<double, 3>{3, 2, 1});
  for (int k = 0; k < 50; ++k) {
    Stress s;
    for (double& v : s) v = random.between(-1, 1);
    const auto p = elasticity::principal(s);
    CHECK(p[0] >= p[1]);
    CHECK(p[1] >= p[2]);
    CHECK(p[0] + p[1] + p[2] == doctest::Approx(s[0] + s[1] + s[2]).epsilon(1e-13));
    CHECK(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] ==
          doctest::Approx(s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])));
    CHECK(elasticity::von_mises({p[0], p[1], p[2], 0, 0, 0}) == doctest::Approx(elasticity::von_mises(s)));
  }
}
