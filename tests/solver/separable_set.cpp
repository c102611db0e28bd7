// Products of intervals and discs: projections and gradients against what defines them.
#include "solver/bounded/separable_set.hpp"

#include <doctest/doctest.h>

#include "../support/known_minimum.hpp"
#include "base/error.hpp"

using namespace dotyk;
using algebra::Vector;
using solver::SeparableSet;
using test::Random;
using test::Shape;

namespace {

using Place = SeparableSet::Place;
constexpr double kInf = test::kNoEnd;

/// Intervals of every kind, then discs: one of radius 0, one far from 0, ordinary ones.
SeparableSet mixed() {
  const Vector low{{-kInf, 0, -1, 2, -kInf, -kInf, -kInf, -kInf, -kInf, -kInf, -kInf}};
  const Vector high{{kInf, kInf, 1, 2, 3, kInf, kInf, kInf, kInf, kInf, kInf}};
  return SeparableSet(low, high, {{5, 8, {1, 1}, 0}, {6, 7, {1e6, -1e6}, 1e-3}, {10, 9, {0.5, 0}, 1}});
}

}  // namespace

TEST_CASE("a projection is in the set, exactly, and the nearest point of it") {
  const SeparableSet set = mixed();
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    const Vector y = random.between(0.1, 1e6) * random.vector(11);
    const Vector p = set.project(y);
    REQUIRE(set.contains(p));
    CHECK((set.project(p) - p).norm() == 0);
    // (y − p)ᵀ(z − p) ≤ 0 for every z of the set; rounding in proportion to both factors.
    const Vector z = set.project(random.between(0.1, 10) * random.vector(11));
    CHECK((y - p).dot(z - p) <= 1e-13 * ((y - p).norm() + 1e6) * (z - p).norm());
  }
  CHECK_FALSE(set.contains(Vector::Constant(11, 5)));
  CHECK_FALSE(set.contains(Vector::Zero(3)));
}

TEST_CASE("the projected gradient is minus the projection of −g onto the tangent cone, split into two orthogonal parts") {
  const SeparableSet set = mixed();
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const Vector x = set.project((k % 2 ? 1.5 : 0.8) * random.vector(11));
    const Vector g = random.vector(11);
    const auto parts = set.gradients(x, g);
    CHECK(std::abs(parts.free.dot(parts.chopped)) <= 1e-15);
    // −g^P = lim (P(x − hg) − x)/h: h below the distance to any end not met, above rounding of the far disc.
    const double h = 1e-4;
    const Vector limit = (x - set.project(x - h * g)) / h;
    for (int i = 0; i < 11; ++i) {
      if (i == 6 || i == 7) continue;  // of radius 1e-3, known to 1e-10
      CHECK(std::abs(parts.free[i] + parts.chopped[i] - limit[i]) <= 3 * h);
    }
    const Vector reduced = set.reduced_free(x, parts.free, 0.7), moved = (x - set.project(x - 0.7 * parts.free)) / 0.7;
    CHECK((reduced - moved).norm() <= 1e-9);  // 1e6 times rounding, by the far disc
    const Vector along = set.tangential(x, parts, random.vector(11));
    CHECK(std::abs(along.dot(parts.chopped)) <= 1e-9);
    for (int i = 0; i < 11; ++i)
      if (parts.face[i] == Place::active) CHECK(along[i] == 0);
  }
}

TEST_CASE("fixed components are active and have no gradient") {
  const SeparableSet set = mixed();
  const auto parts = set.gradients(set.project(Vector::Zero(11)), Vector::Ones(11));
  for (const int i : {3, 5, 8}) {
    CHECK(parts.face[i] == Place::active);
    CHECK(parts.free[i] == 0);
    CHECK(parts.chopped[i] == 0);
  }
}

TEST_CASE("the longest step ends at the boundary, the face gained there; nothing ends a free one") {
  const SeparableSet set(Vector{{-1, -kInf, -kInf, -kInf}}, Vector{{1, kInf, kInf, kInf}}, {{1, 2, {0, 0}, 1}});
  const Vector x{{0.1, 0.3, -0.2, 7}};
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Vector p = random.vector(4);
    const double alpha = set.longest_step(x, p);
    const Vector end = set.along(x, p, alpha);
    CHECK(set.contains(end));
    CHECK((end - (x - alpha * p)).norm() <= 1e-15 * 10);
    CHECK_FALSE(set.contains(x - (1 + 1e-9) * alpha * p));
    const auto face = set.gradients(end, p).face;
    CHECK((face[0] == Place::active || face[1] == Place::sliding));
  }
  CHECK(set.longest_step(x, Vector{{0, 0, 0, 1}}) == kInf);
  CHECK(set.longest_step(x, Vector::Zero(4)) == kInf);
}

TEST_CASE("a pair keeps to its circle, whose curvature is the second derivative along it") {
  const SeparableSet set(Vector::Constant(2, -kInf), Vector::Constant(2, kInf), {{0, 1, {3, 4}, 2}});
  const Vector g{{-0.6, -0.3}}, x{{5, 4}};
  const auto parts = set.gradients(x, g);
  CHECK(parts.face[0] == Place::sliding);
  CHECK(parts.free == Vector{{0, -0.3}});
  CHECK(parts.curvature[1] == doctest::Approx(0.6 / 2));
  // gᵀx on the circle, x = centre + 2(cos t, sin t): second difference in arc length 2t.
  const auto q = [&](double t) { return g.dot(Vector{{3 + 2 * std::cos(t), 4 + 2 * std::sin(t)}}); };
  const double t = 1e-3;
  CHECK(parts.curvature[1] == doctest::Approx((q(t) - 2 * q(0) + q(-t)) / (4 * t * t)).epsilon(1e-5));
  const Vector moved = set.along(x, parts.free, 0.5 * set.longest_step(x, parts.free));
  CHECK((moved - Vector{{3, 4}}).norm() == doctest::Approx(2).epsilon(1e-14));
  CHECK(set.contains(moved));
}

TEST_CASE("sets that are none are refused") {
  const Vector all = Vector::Constant(2, kInf);
  CHECK_THROWS_AS(SeparableSet(Vector{{1.0}}, Vector{{0.0}}), InputError);
  CHECK_THROWS_AS(SeparableSet(Vector{{kInf}}, Vector{{kInf}}), InputError);
  CHECK_THROWS_AS(SeparableSet(Vector{{std::nan("")}}, Vector{{0.0}}), InputError);
  CHECK_THROWS_AS(SeparableSet(-all, Vector::Zero(3)), InputError);
  CHECK_THROWS_AS(SeparableSet(-all, all, {{0, 2, {0, 0}, 1}}), InputError);
  CHECK_THROWS_AS(SeparableSet(-all, all, {{0, 0, {0, 0}, 1}}), InputError);
  CHECK_THROWS_AS(SeparableSet(-all, all, {{0, 1, {0, 0}, -1}}), InputError);
  CHECK_THROWS_AS(SeparableSet(Vector::Zero(2), all, {{0, 1, {0, 0}, 1}}), InputError);
}
