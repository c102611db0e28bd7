#pragma once

#include "feti.hpp"

namespace dotyk::test {

inline bool quadratic(Family family) { return family == Family::p2 || family == Family::q2; }

/// x along the first axis, `last` along the last.
inline Point axis(int dim, double x, double last) { return dim == 2 ? Point{x, last, 0} : Point{x, 0, last}; }

struct Stack {
  std::shared_ptr<scene::Body> low, high;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// Blocks of n and m cells along each edge on top of each other; what holds and loads them is left to the test.
inline Stack stack(int dim, Family one, Family other, int n, int m, double E = 70, double nu = 0.2) {
  Stack s;
  s.low = block("low", dim, one, n);
  s.high = block("high", dim, other, m, 1, E, nu);
  s.scene = scene::make_scene({s.low, s.high});
  return s;
}

/// Contact of the upper block's bottom with the lower's top, or the other way round.
inline void touch(Stack& s, bool upper_first = true, const scene::GivenLaw& friction = {}, std::optional<contact::Pairing> pairing = {}) {
  const auto below = part(s.low, "top"), above = part(s.high, "bottom");
  s.contact = scene::add_contact(*s.scene, upper_first ? above : below, upper_first ? below : above, {}, friction, false, {}, pairing);
}

inline void agree(const scene::Solution& a, const scene::Solution& b, double tolerance) {
  REQUIRE_MESSAGE(a.result().converged, a.result().reason);
  REQUIRE_MESSAGE(b.result().converged, b.result().reason);
  CHECK((a.result().state.u.here() - b.result().state.u.here()).norm() <= tolerance * b.result().state.u.here().norm());
}

}  // namespace dotyk::test
