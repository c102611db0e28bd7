// Graphs of supports' laws: their points satisfy the law, and are the negative subgradient of the superpotential.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "problem/support_graph.hpp"

using namespace dotyk::problem;
namespace laws = dotyk::problem::laws;

namespace {

const GraphWindow window{-2, 2.5, -3, 4};

const std::vector<LawChoice> kLaws{{&laws::free, 0, 0}, {&laws::prescribed, -0.7, 0}, {&laws::load, -1.3, 0}, {&laws::elastic, 1.5, 0},
                                    {&laws::elastic, 0, 0}, {&laws::one_sided_elastic, 1.5, 0}, {&laws::signorini, 0, 0}, {&laws::friction, 0.8, 0},
                                    {&laws::friction, 0, 0}, {&laws::one_sided_friction, 0.8, 0}, {&laws::capped_elastic, 2, 1.1}, {&laws::capped_elastic, 0, 1},
                                    {&laws::capped_elastic, 2, 0}, {&laws::breaking, 2, 1.1}, {&laws::breaking, 0, 1}, {&laws::breaking, 0.1, 5},
                                    {&laws::unequal_elastic, 2, 0.5}, {&laws::unequal_elastic, 0.5, 2},
                                    {&laws::unequal_elastic, 0, 2}, {&laws::unequal_elastic, 2, 0}};

struct OnGraph {
  double v, r;
};

/// Ends and points between them.
std::vector<OnGraph> sample(const std::vector<Curve>& curves) {
  std::vector<OnGraph> out;
  for (const Curve& c : curves)
    for (std::size_t i = 0; i + 1 < c.x.size(); ++i)
      for (int k = 0; k <= 8; ++k)
        out.push_back({c.x[i] + (c.x[i + 1] - c.x[i]) * k / 8, c.y[i] + (c.y[i + 1] - c.y[i]) * k / 8});
  return out;
}

}  // namespace

TEST_CASE("points of a graph satisfy the law by its projection") {
  for (const LawChoice& law : kLaws) {
    const auto row = row_law(law);
    for (const auto& [v, r] : sample(graph(law, window).reaction)) {
      CAPTURE(law.spec->words);
      CAPTURE(v);
      CAPTURE(r);
      if (!row) {
        CHECK(r == (law.is(laws::load) ? law.numbers[0] : 0));
        continue;
      }
      const bool broken = law.is(laws::breaking) && -law.numbers[0] * v > law.numbers[1] * (1 - 1e-12) && r == 0;
      if (broken) continue;
      const double x = (law.is(laws::prescribed) ? law.numbers[0] : 0) - v;
      for (const double rho : {0.1, 1.0, 7.0}) CHECK(row->project(0, r + rho * x, rho).lambda == doctest::Approx(r).epsilon(1e-12).scale(1));
    }
  }
}

TEST_CASE("a reaction is a negative subgradient of the superpotential") {
  for (const LawChoice& law : kLaws) {
    const SupportGraph g = graph(law, window);
    if (law.is(laws::breaking) && law.numbers[0] * law.numbers[1] > 0) continue;  // not convex
    for (const auto& [v, r] : sample(g.reaction))
      for (double w = -2; w <= 2.5; w += 0.125) {
        CAPTURE(law.spec->words);
        CAPTURE(v);
        CAPTURE(w);
        CHECK(energy(law, w) >= energy(law, v) - r * (w - v) - 1e-12);
      }
  }
}

TEST_CASE("where it breaks, a support's superpotential goes on without a step, and the reaction jumps") {
  const LawChoice law{&laws::breaking, 2, 1.1};
  const SupportGraph g = graph(law, window);
  REQUIRE(g.reaction.size() == 2);
  REQUIRE(g.jumps.size() == 1);
  CHECK(g.jumps[0].x[0] == -0.55);
  CHECK(g.jumps[0].y == std::vector<double>{0, 1.1});
  for (double v = -1.9; v < 2.4; v += 0.1) {  // no kink of φ among these v
    const double r = v < -0.55 || v > 0 ? 0 : -2 * v, h = 1e-6;
    if (std::abs(v) < 0.01) continue;
    CHECK(-(energy(law, v + h) - energy(law, v - h)) / (2 * h) == doctest::Approx(r).epsilon(1e-8).scale(1));
  }
  CHECK(energy(law, -0.55) == doctest::Approx(energy(law, -0.5500001)).epsilon(1e-6));
  // One that breaks beyond the window is whole within it.
  CHECK(graph({&laws::breaking, 0.1, 5}, window).reaction.size() == 1);
}

TEST_CASE("graphs and superpotentials cover the window, but where the law forbids displacements") {
  for (const LawChoice& law : kLaws) {
    const SupportGraph g = graph(law, window);
    CAPTURE(law.spec->words);
    CHECK(g.reaction.front().x.front() == std::max(window.low, g.low));
    CHECK(g.reaction.back().x.back() == std::min(window.high, g.high));
    CHECK(g.energy.x.front() == std::max(window.low, g.low));
    CHECK(g.energy.x.back() == std::min(window.high, g.high));
    for (std::size_t i = 0; i < g.energy.x.size(); ++i) CHECK(g.energy.y[i] == energy(law, g.energy.x[i]));
    if (std::isfinite(g.low)) CHECK(energy(law, g.low - 0.1) == Law::kUnbounded);
    if (std::isfinite(g.high)) CHECK(energy(law, g.high + 0.1) == Law::kUnbounded);
  }
}
