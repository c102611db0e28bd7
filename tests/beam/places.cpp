// Supports that stand elsewhere than at 0: u ≥ h, and every other law about u − h.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"
#include "base/error.hpp"

using namespace dotyk;
using beam::Beam;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::beam_between;
using test::kEJ;
using test::kFree;
using test::kHeld;
using test::kLength;
using test::only;

TEST_CASE("a cantilever over a stop at h: u(L) = max(h, qL⁴/8EJ), R = 3EJ (h − qL⁴/8EJ)/L³") {
  const double q = -1, rest = q * std::pow(kLength, 4) / (8 * kEJ);
  for (const double h : {-0.9, -0.5, 0.0, 0.3}) {
    CAPTURE(h);
    Beam b = beam_between(kLength, kEJ, q, kHeld, kHeld, {&laws::signorini}, kFree);
    b.supports[1].deflection_at = h;
    const auto s = only(b);
    CHECK(s->deflection(kLength) == doctest::Approx(std::max(h, rest)).epsilon(1e-10));
    CHECK(s->reaction(1).force == doctest::Approx(std::max(0.0, 3 * kEJ * (h - rest) / std::pow(kLength, 3))).epsilon(1e-10));
    CHECK(s->residual().penetration < 1e-12);
  }
}

TEST_CASE("a stop for the slope of a simply supported beam at g: u'(0) = min(g, qL³/24EJ), M = 3EJ (g − qL³/24EJ)/L") {
  const double q = 1, rest = q * std::pow(kLength, 3) / (24 * kEJ);
  for (const double g : {-0.1, 0.05, 0.2}) {
    CAPTURE(g);
    Beam b = beam_between(kLength, kEJ, q, kHeld, {&laws::signorini}, kHeld, kFree);
    b.supports[0].rotation_at = g;
    const auto s = only(b);
    CHECK(s->rotation(0) == doctest::Approx(std::min(g, rest)).epsilon(1e-10));
    CHECK(s->reaction(0).moment == doctest::Approx(std::min(0.0, 3 * kEJ * (g - rest) / kLength)).scale(1).epsilon(1e-10));
  }
}

TEST_CASE("places that are a rigid motion move the beam by it: reactions, energy and what is broken stay") {
  const double up = 0.4, turn = -0.15;
  for (const problem::LawSpec* kind : {&laws::prescribed, &laws::elastic, &laws::one_sided_elastic, &laws::signorini, &laws::friction, &laws::one_sided_friction, &laws::capped_elastic,
                          &laws::unequal_elastic, &laws::breaking})
    for (const double q : {-1.0, -0.3}) {
      const LawChoice law{kind, kind == &laws::prescribed ? 0.01 : 1.5, 0.4, 0.7};
      Beam still = beam_between(kLength, kEJ, q, {&laws::elastic, 20}, law, law, law);
      still.supports.insert(still.supports.begin() + 1, {"middle", 0.7, law, {&laws::elastic, 0.3}});
      Beam moved = still;
      for (beam::Support& s : moved.supports) s.deflection_at = up + turn * s.x, s.rotation_at = turn;
      CAPTURE(kind->words);
      Monitor monitor;
      const auto a = beam::solve(still, {}, monitor), b = beam::solve(moved, {}, monitor);
      CHECK(a.size() == b.size());
      for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) {
        CHECK(a[k].broken == b[k].broken);
        for (const double x : {0.0, 1.1, kLength})
          CHECK(b[k].solution->deflection(x) == doctest::Approx(a[k].solution->deflection(x) + up + turn * x).scale(1).epsilon(1e-10));
        for (int i = 0; i < 3; ++i) {
          CHECK(b[k].solution->reaction(i).force == doctest::Approx(a[k].solution->reaction(i).force).scale(1).epsilon(1e-10));
          CHECK(b[k].solution->reaction(i).moment == doctest::Approx(a[k].solution->reaction(i).moment).scale(1).epsilon(1e-10));
        }
        // The load goes along: −q(up·L + turn·L²/2).
        CHECK(b[k].solution->energy() - a[k].solution->energy() == doctest::Approx(-q * (up * kLength + turn * kLength * kLength / 2)).epsilon(1e-9));
      }
    }
}

TEST_CASE("a place that is no number is refused") {
  Beam b = beam_between(kLength, kEJ, -1, kHeld, kHeld, {&laws::signorini}, kFree);
  b.supports[1].deflection_at = NAN;
  CHECK_THROWS_AS(only(b), InputError);
}
