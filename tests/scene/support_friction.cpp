// Laws of supports along the tangents of a part.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/laws.hpp"
#include "base/error.hpp"
#include "problem/solvability.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/uzawa.hpp"
#include "solver/rows/uzawa_pdas.hpp"

using namespace dotyk;
using mesh::Point;
namespace laws = dotyk::problem::laws;
using test::Laws;

namespace {

/// A block on a law, pressed and pushed along the direction at its top.
std::shared_ptr<scene::Body> pushed(int dimension, const Laws& normal, const Laws& tangential, double push, double angle = 0, int n = 3) {
  const auto block = test::block("block", dimension, mesh::Family::p1, n);
  test::support(block, "bottom", normal, tangential);
  test::pull(block, "top", [=](const Point&) {
    return dimension == 2 ? Point{push, -4, 0} : Point{push * std::cos(angle), push * std::sin(angle), -4};
  });
  return block;
}

std::shared_ptr<scene::Solution> solve(const std::shared_ptr<scene::Body>& body, const solver::Method& method = {}) {
  return test::solve_by(scene::make_scene({body}), method);
}

scene::Model model_of(const std::shared_ptr<scene::Body>& body) {
  problem::Clock clock;
  Monitor quiet;
  return scene::build(*scene::make_scene({body}), clock, quiet);
}

}  // namespace

TEST_CASE("below the bound friction holds the part as a fixed tangent does") {
  for (const int dimension : {2, 3}) {
    const auto held = pushed(dimension, {&laws::elastic, 50}, {}, 0.3);
    test::fix(held, "bottom", {true, dimension == 3, false});
    const auto stuck = solve(pushed(dimension, {&laws::elastic, 50}, {&laws::friction, 10}, 0.3));
    CHECK(test::distance(*stuck, *solve(held)) < 1e-10);
    CHECK(test::distance(*solve(pushed(dimension, {&laws::elastic, 50}, {&laws::prescribed, 0}, 0.3)), *solve(held)) < 1e-10);
    const auto r = stuck->support(test::part(stuck->scene().bodies[0], "bottom"));
    for (const scene::SupportNode& node : r.nodes) CHECK(node.tangential == problem::Status::stick);
    CHECK(r.force[0] == doctest::Approx(-0.3).epsilon(1e-10));
    CHECK(test::imbalance(*stuck, {"bottom"}) < 1e-10);
  }
}

TEST_CASE("friction carries up to bound times area, alike in all directions") {
  const double g = 1.5;
  for (const int dimension : {2, 3})
    for (const double angle : {0.0, 0.5, 0.785398}) {
      if (dimension == 2 && angle > 0) continue;
      const auto near = solve(pushed(dimension, {&laws::elastic, 50}, {&laws::friction, g}, 0.998 * g, angle));
      REQUIRE(near->result().converged);
      int slips = 0;
      for (const scene::SupportNode& node : near->support(test::part(near->scene().bodies[0], "bottom")).nodes) {
        const double shear = std::hypot(node.shear[0], node.shear[1], node.shear[2]), slip = std::hypot(node.slip[0], node.slip[1]);
        CHECK(shear < g * (1 + 1e-9));
        if (node.tangential == problem::Status::stick) continue;
        ++slips;  // against its own slip
        CHECK(shear == doctest::Approx(g).epsilon(1e-9));
        CHECK(node.shear[0] * node.slip[0] + node.shear[1] * node.slip[1] == doctest::Approx(-g * slip).epsilon(1e-6));
      }
      CHECK(slips > 0);
      CHECK(test::imbalance(*near, {"bottom"}) < 1e-8);
      CHECK_THROWS_WITH_AS(solve(pushed(dimension, {&laws::elastic, 50}, {&laws::friction, g}, 1.002 * g, angle)),
                           doctest::Contains("nothing stops 'block': translation along"), InputError);
    }
}

TEST_CASE("friction bears a torque up to bound times the sum of the nodes' distances") {
  const double g = 1.5;
  for (const int n : {3, 6}) {
    const auto twisted = [&](double torque) {
      const auto block = test::block("block", 3, mesh::Family::q1, n);
      test::support(block, "bottom", {&laws::one_sided_elastic, 50}, {&laws::friction, g});
      // ∫ 6 r² dA = 1
      test::pull(block, "top", [=](const Point& x) { return Point{-6 * torque * (x[1] - 0.5), 6 * torque * (x[0] - 0.5), -40}; });
      const scene::Model model = model_of(block);
      return problem::solvability(problem::rigid_motions(model.problem), model.problem);
    };
    double limit = 0;
    const auto block = test::block("block", 3, mesh::Family::q1, n);
    for (const auto& node : contact::nodes(*block->mesh, block->mesh->parts.at("bottom"))) {
      const Point x = block->mesh->point(node.node);
      limit += g * node.weight * std::hypot(x[0] - 0.5, x[1] - 0.5);
    }
    CHECK(limit == doctest::Approx(0.3826 * g).epsilon(0.3 / n));  // of the square as a whole
    using Verdict = problem::Solvability::Verdict;
    for (const double part : {0.5, 0.9, 0.98, 0.999}) CHECK(twisted(part * limit).verdict == Verdict::unique);
    const auto edge = twisted((1 - 1e-6) * limit);
    CHECK(edge.verdict != Verdict::unsolvable);
    CHECK(edge.limit);
    for (const double part : {1 + 1e-5, 1.001, 1.1, 1.5}) {
      const auto s = twisted(part * limit);
      CHECK(s.verdict == Verdict::unsolvable);
      CHECK(s.work > 0);
    }
  }
}

TEST_CASE("friction on a rigid base is given friction of contact with a rigid half-space") {
  for (const int dimension : {2, 3}) {
    const double g = 1.5;
    const auto law = pushed(dimension, {&laws::signorini}, {&laws::friction, g}, 0.9 * g, 0.4, 4);
    const auto met = pushed(dimension, {}, {}, 0.9 * g, 0.4, 4);
    met->laws.clear();
    auto with_contact = scene::make_scene({met});
    Point up{0, 0, 0};
    up[dimension - 1] = 1;
    const auto contact = scene::add_contact(*with_contact, test::part(met, "bottom"), contact::RigidPlane{{0, 0, 0}, up}, {}, false,
                                            {problem::laws::friction, [=](const Point&) { return g; }});
    const auto a = solve(law), b = test::solve_by(with_contact, solver::Newton{});
    CHECK(test::distance(*a, *b) < 1e-9);
    CHECK(a->friction_energy() == doctest::Approx(b->friction_energy()).epsilon(1e-9));
    CHECK(a->energy() == doctest::Approx(b->energy()).epsilon(1e-9));
    const auto mine = a->support(test::part(law, "bottom"));
    const auto other = b->contact(*contact);
    for (int i = 0; i < dimension; ++i) CHECK(mine.force[i] == doctest::Approx(other.force[i]).epsilon(1e-9));
  }
}

TEST_CASE("every method that treats friction gives the same, with a foundation or held along the normal") {
  for (const int dimension : {2, 3})
    for (const Laws normal : {Laws{&laws::one_sided_elastic, 20}, Laws{}}) {
      const auto body = pushed(dimension, normal, {&laws::friction, 1}, 0.8, 0.4);
      if (normal.is(laws::free)) test::fix(body, "bottom", {false, dimension == 2, dimension == 3});
      const auto exact = solve(body);
      CHECK(test::distance(*solve(body, solver::Proximal{}), *exact) < 1e-7);
      CHECK(test::distance(*solve(body, test::patient(solver::UzawaPdas{})), *exact) < 1e-7);
      CHECK(test::distance(*solve(body, test::feti(1)), *exact) < 1e-7);
      CHECK(test::distance(*solve(body, test::feti(4)), *exact) < 1e-7);
      for (auto method : {test::patient(solver::Psor{}), test::patient(solver::Uzawa{}), test::patient(solver::ProjectedCg{})})
        CHECK(test::distance(*solve(body, method), *exact) < 1e-5);  // slowly converging: they stop by the residual of λ
      CHECK_THROWS_WITH_AS(solve(body, solver::Pdas{}), doctest::Contains("pdas cannot treat the given friction of the tangential support of 'block' bottom"), InputError);
    }
}

TEST_CASE("a spring along the tangents bears k times the mean slip, and slides at its greatest force") {
  const double k = 8, g = 2;
  const auto mean_slip = [](const scene::Solution& s) {
    double sum = 0;
    for (const scene::SupportNode& n : s.support(test::part(s.scene().bodies[0], "bottom")).nodes) sum += n.weight * n.slip[0];
    return sum;
  };
  for (const int dimension : {2, 3}) {
    const auto s = solve(pushed(dimension, {&laws::elastic, 50}, {&laws::elastic, k}, 0.7));
    CHECK(mean_slip(*s) == doctest::Approx(0.7 / k).epsilon(1e-10));
    double work = 0;  // Clapeyron: all is linear
    const auto& f = s->scene().bodies[0]->force;
    for (std::size_t i = 0; i < f.size(); ++i) work += f[i] * s->displacement(0)[i];
    CHECK(s->energy() == doctest::Approx(-0.5 * work).epsilon(1e-11));
  }
  CHECK(mean_slip(*solve(pushed(2, {&laws::elastic, 50}, {&laws::capped_elastic, k, 10}, 0.7))) == doctest::Approx(0.7 / k).epsilon(1e-10));
  const auto limit = solve(pushed(2, {&laws::elastic, 50}, {&laws::capped_elastic, k, g}, 0.98 * g));
  const auto nodes = limit->support(test::part(limit->scene().bodies[0], "bottom")).nodes;
  int slips = 0;
  for (const auto& n : nodes) {
    slips += n.tangential == problem::Status::slip;
    CHECK(n.shear[0] == doctest::Approx(-std::min(k * n.slip[0], g)).epsilon(1e-9));
  }
  CHECK(slips > 0);
  CHECK_THROWS_WITH_AS(solve(pushed(2, {&laws::elastic, 50}, {&laws::capped_elastic, k, g}, 1.01 * g)),
                       doctest::Contains("nothing stops 'block': translation along x"), InputError);
}

TEST_CASE("a held normal leaves friction along the part, and held nodes have no rows") {
  const auto block = pushed(2, {}, {&laws::friction, 1}, 0.9);
  test::fix(block, "bottom", {false, true, false});
  const auto s = solve(block);
  REQUIRE(s->result().converged);
  CHECK(s->reaction(test::part(block, "bottom"))[0] == doctest::Approx(-0.9).epsilon(1e-9));
  CHECK(s->reaction(test::part(block, "bottom"))[1] == doctest::Approx(4).epsilon(1e-9));

  const auto corner = test::block("corner", 2, mesh::Family::p1, 3);
  test::fix(corner, "left");
  test::support(corner, "bottom", {&laws::signorini}, {&laws::friction, 1});
  test::press(corner, "top", 1);
  CHECK(test::imbalance(*solve(corner), {"left", "bottom"}) < 1e-10);
}

TEST_CASE("in a history friction of a support remembers, as that of contact does") {
  const double g = 1.5;
  const auto law = pushed(2, {&laws::signorini}, {&laws::friction, g}, 0, 0, 4), met = pushed(2, {}, {}, 0, 0, 4);
  met->laws.clear();
  std::vector<scene::Step> steps;
  for (const auto& b : {law, met}) {
    auto top = test::part(b, "top");
    scene::load(top, [](const Point&) { return Point{1, 0, 0}; }, "push");
  }
  for (const double push : {1.4, 0.2, -1.3, 0.0}) {
    scene::Step step;
    step.factor["push"] = push;
    steps.push_back(step);
  }
  auto with_contact = scene::make_scene({met});
  scene::add_contact(*with_contact, test::part(met, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false,
                     {problem::laws::friction, [=](const Point&) { return g; }});
  Monitor quiet;
  const auto a = scene::solve(scene::make_scene({law}), {}, {}, quiet, steps), b = scene::solve(with_contact, {}, {}, quiet, steps);
  REQUIRE(a->result().converged);
  CHECK(test::distance(*a, *b) < 1e-8);
  const auto once = scene::solve(scene::make_scene({law}), {}, {}, quiet, {steps.back()});
  CHECK(test::distance(*once, *a) > 0.01);  // what it remembers
}
