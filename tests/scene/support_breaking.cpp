// Supports that break, on parts of a body: the cascade against every choice of broken nodes.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/laws.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Point;
namespace laws = dotyk::problem::laws;
using test::Laws;

namespace {

constexpr double kStiffness = 40, kLimit = 1.2;

/// A soft block clamped at its left, under a load that grows to the right, on a foundation that breaks.
std::shared_ptr<scene::Body> loaded(double load, int n = 4) {
  const auto block = test::block("block", 2, mesh::Family::p1, n, 0, 30);
  test::fix(block, "left");
  test::support(block, "bottom", {&laws::breaking, kStiffness, kLimit});
  test::pull(block, "top", [=](const Point& x) { return Point{0, -load * x[0], 0}; });
  return block;
}

/// Does every whole node bear at most the limit, and is every broken one displaced by more than what breaks it?
bool consistent(const scene::Solution& s) {
  for (const scene::SupportNode& node : s.support(test::part(s.scene().bodies[0], "bottom")).nodes)
    if (node.broken != (-kStiffness * node.away > kLimit * (1 + 1e-9))) return false;
  return true;
}

int broken(const scene::Solution& s) { return s.support(test::part(s.scene().bodies[0], "bottom")).broken; }

std::vector<std::shared_ptr<scene::Solution>> local_minima(double load) {
  std::vector<std::shared_ptr<scene::Solution>> minima;
  for (int choice = 0; choice < 32; ++choice) {
    const auto body = loaded(load);
    auto& law = body->laws.front();
    law.normal.law.numbers[1] = 1e9;  // what is whole does not break
    for (int k = 0; k < 5; ++k) law.broken.push_back(choice >> k & 1);
    const auto s = test::solve(scene::make_scene({body}));
    if (s->result().converged && consistent(*s)) minima.push_back(s);
  }
  return minima;
}

}  // namespace

TEST_CASE("a foundation that breaks is a one-sided one up to its limit") {
  const auto whole = loaded(0.5), other = loaded(0.5);
  other->laws.front().normal = {&laws::one_sided_elastic, kStiffness};
  const auto s = test::solve(scene::make_scene({whole}));
  CHECK(broken(*s) == 0);
  CHECK(test::distance(*s, *test::solve(scene::make_scene({other}))) < 1e-14);
}

TEST_CASE("the cascade ends in one of the local minima that trying every choice of broken nodes finds") {
  int some = 0, several = 0;
  for (const double load : {1.0, 1.8, 2.0, 2.2, 2.5, 3.0, 4.0}) {
    const auto minima = local_minima(load);
    REQUIRE(!minima.empty());
    several += minima.size() > 1;
    const auto s = test::solve(scene::make_scene({loaded(load)}));
    REQUIRE(s->result().converged);
    CHECK(consistent(*s));
    double nearest = INFINITY;
    for (const auto& m : minima) nearest = std::min(nearest, test::distance(*s, *m));
    CHECK(nearest < 1e-10);
    CHECK(test::imbalance(*s, {"left", "bottom"}) < 1e-10);
    const int count = broken(*s);
    some += count > 0 && count < 4;
    CHECK((s->result().reason.find("one local minimum of the energy") != std::string::npos) == (count > 0));
  }
  CHECK(some > 0);
  CHECK(several > 0);
}

TEST_CASE("breaking takes half g²/k of energy for each length broken") {
  const auto s = test::solve(scene::make_scene({loaded(4)}));
  const auto without = loaded(4);
  without->laws.clear();
  REQUIRE(broken(*s) == 4);  // all but the one at the clamped corner, which stands for an eighth
  const double taken = s->energy() - test::solve(scene::make_scene({without}))->energy();
  CHECK(taken == doctest::Approx(0.875 * 0.5 * kLimit * kLimit / kStiffness).epsilon(1e-10));
}

TEST_CASE("methods break the same nodes, and what is broken stays so in a history") {
  const auto exact = test::solve(scene::make_scene({loaded(2.5, 8)}));
  REQUIRE(broken(*exact) > 0);
  REQUIRE(broken(*exact) < 8);
  for (const auto& method : {solver::Method(solver::Newton{}), solver::Method(solver::Proximal{}), solver::Method(test::feti(3))})
    CHECK(test::distance(*test::solve_by(scene::make_scene({loaded(2.5, 8)}), method), *exact) < 1e-7);
  std::vector<scene::Step> steps(2);
  steps[0].all = 1.0;
  steps[1].all = 0.2;
  Monitor quiet;
  const auto unloaded = scene::solve(scene::make_scene({loaded(2.5, 8)}), {}, {}, quiet, steps);
  CHECK(broken(*unloaded) == broken(*exact));
  CHECK(unloaded->result().reason.find("no local minimum") != std::string::npos);
  CHECK(broken(*test::solve(scene::make_scene({loaded(0.2 * 2.5, 8)}))) == 0);
  scene::Start after;
  after.after = exact;
  const auto later = scene::solve(scene::make_scene({loaded(0.2 * 2.5, 8)}), {}, after, quiet);
  CHECK(test::distance(*later, *unloaded) < 1e-10);
}
