#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"

using namespace dotyk;
using beam::Beam;
using problem::SupportLaw;
using Kind = SupportLaw::Kind;
using test::kFree;
using test::kHeld;

namespace {

constexpr double kLength = 2, kEJ = 3, kSpring = 10, kLimit = 0.2;

/// A cantilever whose tip rests on a support that breaks.
Beam cantilever(double force) {
  Beam b = test::beam_between(kLength, kEJ, 0, kHeld, kHeld, {Kind::breaking, kSpring, kLimit}, kFree);
  b.loads = {{kLength, -force, 0}};
  return b;
}

}  // namespace

TEST_CASE("a support that breaks: every local minimum, each with its branch") {
  // The cantilever's own stiffness is c = 3EJ/L³: whole, the tip's force F is shared as k : c, and the support bears
  // kF/(k + c) ≤ g; broken, the tip goes down F/c ≥ g/k.
  Monitor monitor;
  const double c = 3 * kEJ / std::pow(kLength, 3), up_to = kLimit * (kSpring + c) / kSpring, from = kLimit * c / kSpring;
  for (const double force : {0.5 * from, 0.99 * from, 1.01 * from, 0.5 * (from + up_to), 0.99 * up_to, 1.01 * up_to, 2 * up_to}) {
    CAPTURE(force);
    const auto minima = beam::solve(cantilever(force), {}, monitor);
    const bool whole = force < up_to, broken = force > from;
    REQUIRE(minima.size() == std::size_t(whole) + std::size_t(broken));
    double last = -INFINITY;
    for (const auto& [choice, s] : minima) {
      const bool is_broken = choice[0] == beam::Broken::yes;
      CHECK((is_broken ? broken : whole));
      const double tip = is_broken ? -force / c : -force / (kSpring + c);
      CHECK(s->deflection(kLength) == doctest::Approx(tip).epsilon(1e-10));
      // ½cu² + Fu + φ(u): the least first.
      const double energy = 0.5 * c * tip * tip + force * tip + (is_broken ? 0.5 * kLimit * kLimit / kSpring : 0.5 * kSpring * tip * tip);
      CHECK(s->energy() == doctest::Approx(energy).epsilon(1e-9));
      CHECK(s->energy() > last);
      last = s->energy();
      CHECK(s->reaction(1).force == doctest::Approx(is_broken ? 0 : -kSpring * tip).epsilon(1e-9));
    }
  }
}

TEST_CASE("several supports that break, in deflection and rotation") {
  Beam b = test::beam_between(4, 1, -1, {Kind::prescribed, 0, 0}, {Kind::breaking, 50, 1.2}, {Kind::breaking, 30, 2}, kFree);
  b.supports.insert(b.supports.begin() + 1, {"middle", 2, {Kind::breaking, 20, 3}, kFree});
  Monitor monitor;
  const auto minima = beam::solve(b, {}, monitor);
  CHECK(minima.size() >= 1);
  for (const auto& [choice, s] : minima)
    for (int i = 0; i < 3; ++i) {
      const beam::Reaction r = s->reaction(i);
      const auto& law = b.supports[i].deflection;
      if (law.kind != Kind::breaking) continue;
      const double down = -r.deflection;
      const double expected = down <= 0 ? 0 : law.value * down > law.limit ? 0 : law.value * down;
      CHECK(std::abs(r.force - expected) < 1e-8);
    }
}
