#include <doctest/doctest.h>

#include <cmath>

#include "../support/semicoercive.hpp"
#include "base/error.hpp"
#include "problem/rigid_motions.hpp"
#include "program/active_set.hpp"
#include "program/interior_point.hpp"
#include "punch.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/programs/penalty.hpp"

// The solution of a frictionless scene is unique (up to motions that no row notices, where all methods take the
// least), so methods that have nothing in common but the problem have to agree.

using namespace dotyk;
using mesh::Point;

namespace {

struct Named {
  std::string name;
  std::shared_ptr<scene::Scene> scene;
};

std::shared_ptr<scene::Scene> two_blocks() {
  const auto lower = test::block("lower", 2, mesh::Family::p1, 8, -1, 1000);
  mesh::Mesh arched = test::unit(2, mesh::Family::p1, 8);
  mesh::transform(arched, [](Point x) { return x[1] += 0.03 * x[0] * x[0], x; });
  const auto upper = test::body("upper", std::move(arched), 4000);
  test::fix(lower, "bottom");
  test::slide(lower, "left");
  test::slide(upper, "left");
  test::press(upper, "top", 20);
  auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {});
  return scene;
}

std::shared_ptr<scene::Scene> stack() {
  std::vector<std::shared_ptr<scene::Body>> blocks;
  for (int k = 0; k < 5; ++k) blocks.push_back(test::block("block " + std::to_string(k), 2, mesh::Family::q1, 5, k, 2000));
  // The middle of the load is off the middle of the blocks: contacts open at one side.
  test::pull(blocks.back(), "top", [](const Point& x) { return Point{0, -10 * x[0] * x[0], 0}; });
  auto scene = scene::make_scene(blocks);
  scene::add_contact(*scene, test::part(blocks[0], "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  for (int k = 1; k < 5; ++k)
    scene::add_contact(*scene, test::part(blocks[k], "bottom"), test::part(blocks[k - 1], "top"), {});
  return scene;
}

std::shared_ptr<scene::Scene> ball() {
  mesh::Mesh m = test::unit(3, mesh::Family::q1, 4);
  mesh::transform(m, [](Point p) {
    const double x = 2 * p[0] - 1, y = 2 * p[1] - 1, z = 2 * p[2] - 1;
    return Point{x * std::sqrt(1 - y * y / 2 - z * z / 2 + y * y * z * z / 3),
                 y * std::sqrt(1 - z * z / 2 - x * x / 2 + z * z * x * x / 3),
                 z * std::sqrt(1 - x * x / 2 - y * y / 2 + x * x * y * y / 3)};
  });
  const auto body = scene::make_body(
      "ball", std::make_shared<const mesh::Mesh>(std::move(m)),
      elasticity::MaterialField(elasticity::isotropic(2000, 0.25, 3, elasticity::Plane::strain)),
      [](const Point&) { return Point{0, 0, -4}; });
  const scene::Part lower =
      scene::chosen_part(body, "lower", [](const Point&, const Point& n) { return n[2] < -0.3; });
  auto scene = scene::make_scene({body});
  const auto gap = [](const Point& x) { return std::max(0.0, x[2] - (0.35 * (x[0] * x[0] + x[1] * x[1]) - 1)); };
  scene::add_contact(*scene, lower, contact::RigidGap{{0, 0, -1}, gap}, {}, false);
  return scene;
}

/// A block on elastic springs under one that is glued to it, pressed by a parabola.
std::shared_ptr<scene::Scene> mixed() {
  const auto lower = test::block("lower", 2, mesh::Family::q1, 6, -1, 300),
             upper = test::block("upper", 2, mesh::Family::q1, 6, 0, 500);
  test::springs(lower, "bottom", {40, 70, 0});
  auto scene = scene::make_scene({lower, upper});
  scene::add_glue(*scene, test::part(upper, "bottom"), test::part(lower, "top"));
  scene::add_contact(*scene, test::part(upper, "top"),
                     contact::RigidGap{{0, 1, 0}, [](const Point& x) { return x[0] * x[0] / 4 - 0.02; }}, {}, false);
  return scene;
}

std::vector<Named> scenes() {
  std::vector<Named> all = {{"punch in the plane", punch::plane(16).scene}, {"punch in space", punch::space(5).scene},
                            {"two blocks", two_blocks()}, {"five free blocks", stack()}, {"a ball in a bowl", ball()},
                            {"glue and springs", mixed()}};
  for (const test::Case& c : test::semicoercive_cases()) all.push_back({c.name, c.scene});
  return all;
}

std::shared_ptr<scene::Solution> solve(const std::shared_ptr<scene::Scene>& s, const solver::Method& method) {
  Monitor quiet;
  return scene::solve(s, method, {}, quiet);
}

double difference(const algebra::Vector& a, const algebra::Vector& b) { return (a - b).norm() / b.norm(); }

double distance(const scene::Solution& a, const scene::Solution& b) {
  return std::max(difference(a.result().state.u.here(), b.result().state.u.here()),
                  difference(a.result().state.lambda, b.result().state.lambda));
}

solver::ActiveSet active_set(solver::ActiveSet::Change change, bool reduced) {
  solver::ActiveSet method;
  method.change = change;
  method.reduced = reduced;
  method.max_iterations = 2000;
  return method;
}

}  // namespace

TEST_CASE("active_set finds what pdas finds, on the boundary and on all unknowns, one row a step and many") {
  using Change = solver::ActiveSet::Change;
  for (const Named& c : scenes()) {
    const auto exact = solve(c.scene, solver::Pdas{});
    REQUIRE(exact->result().converged);
    for (const bool reduced : {true, false})
      for (const Change change : {Change::one, Change::many}) {
        CAPTURE(c.name);
        CAPTURE(reduced);
        CAPTURE(change);
        const auto s = solve(c.scene, active_set(change, reduced));
        REQUIRE_MESSAGE(s->result().converged, s->result().reason);
        CHECK(distance(*s, *exact) < 1e-9);
        CHECK(s->residual().equilibrium < 1e-9);  // the method's tolerance, 1e-10 of its own units, of the load alone
        CHECK(s->result().history.size() > 0);
        REQUIRE(s->result().working_set);
        CHECK(s->result().working_set->survived == s->result().working_set->singular);
      }
  }
}

TEST_CASE("a block above the ground falls first: its KKT system is singular, and survived") {
  for (const bool reduced : {true, false}) {
    const auto block = test::block("block", 2, mesh::Family::q1, 4, 0.5);
    test::slide(block, "left");
    test::press(block, "top", 1);
    auto scene = scene::make_scene({block});
    scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
    for (const auto change : {solver::ActiveSet::Change::one, solver::ActiveSet::Change::many}) {
      const auto s = solve(scene, active_set(change, reduced));
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      CHECK(s->result().working_set->singular >= 1);
      CHECK(s->result().working_set->survived == s->result().working_set->singular);
      for (double l : s->result().state.lambda) CHECK(l > 0);
      CHECK(distance(*s, *solve(scene, solver::Pdas{})) < 1e-9);
    }
  }
}

TEST_CASE("interior_point comes as near as its tolerance, and calls the same nodes closed") {
  for (const Named& c : scenes()) {
    const auto exact = solve(c.scene, solver::Pdas{});
    for (const bool reduced : {true, false}) {
      CAPTURE(c.name);
      CAPTURE(reduced);
      solver::InteriorPoint method;
      method.reduced = reduced;
      const auto s = solve(c.scene, method);
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      CHECK(distance(*s, *exact) < 1e-6);
      const double peak = exact->result().state.lambda.maxCoeff();
      for (int r = 0; r < s->rows(); ++r)  // where strictly complementary
        if (std::abs(exact->result().state.lambda[r]) > 1e-6 * peak) CHECK(s->active(r));
    }
  }
}

TEST_CASE("penalty errs by O(1/factor), says so, and its estimate of the energy bounds the truth") {
  for (const Named& c : scenes()) {
    const auto exact = solve(c.scene, solver::Pdas{});
    for (const bool reduced : {true, false}) {
      CAPTURE(c.name);
      CAPTURE(reduced);
      std::vector<double> errors;
      for (double factor : {1e3, 1e4, 1e5}) {
        CAPTURE(factor);
        solver::Penalty method;
        method.factor = factor;
        method.reduced = reduced;
        const auto s = solve(c.scene, method);
        REQUIRE_MESSAGE(s->result().converged, s->result().reason);
        REQUIRE(s->result().penalty);
        errors.push_back(difference(s->result().state.u.here(), exact->result().state.u.here()));
        const double off = exact->energy() - s->energy(), estimate = s->result().penalty->energy;
        const double rounding = 1e-11 * std::abs(exact->energy());
        CHECK(off >= estimate - rounding);
        CHECK(off == doctest::Approx(estimate).epsilon(30 / factor).scale(rounding));
        CHECK(s->result().penalty->penetration > 0);
        CHECK(s->residual().penetration > 0);
        CHECK(s->result().reason.find("penetration up to") != std::string::npos);
      }
      // Order 1: tenfold stiffness, a tenth of the error, once contacts no longer change.
      CHECK(std::log10(errors[0] / errors[1]) == doctest::Approx(1).epsilon(0.05));
      CHECK(std::log10(errors[1] / errors[2]) == doctest::Approx(1).epsilon(0.05));
    }
  }
}

TEST_CASE("penalty on the contact rows loses no digits however stiff; the classical way does") {
  const auto scene = punch::plane(16).scene;
  const auto exact = solve(scene, solver::Pdas{});
  solver::Penalty method;
  method.factor = 1e12;
  CHECK(distance(*solve(scene, method), *exact) < 1e-11);
  method.reduced = false;
  const auto classical = solve(scene, method);
  CHECK(difference(classical->result().state.lambda, exact->result().state.lambda) > 1e-8);
}

TEST_CASE("these methods refuse friction, naming one that can, and loads that nothing balances, by the motion") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  test::press(block, "top", -1);
  auto lifted = scene::make_scene({block});
  scene::add_contact(*lifted, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  const auto rubbed = test::block("block", 2, mesh::Family::p1, 2);
  auto rubs = scene::make_scene({rubbed});
  scene::add_contact(*rubs, test::part(rubbed, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false,
                     {problem::laws::coulomb, [](const Point&) { return 0.3; }});
  for (const solver::Method& method : {solver::Method(solver::ActiveSet{}), solver::Method(solver::InteriorPoint{}),
                                       solver::Method(solver::Penalty{})}) {
    CHECK_THROWS_WITH_AS(solve(lifted, method), doctest::Contains("nothing stops 'block': translation along"), InputError);
    CHECK_THROWS_WITH_AS(solve(rubs, method), doctest::Contains("newton, proximal, uzawa, uzawa_pdas, psor, projected_cg, coulomb_loop and feti can"), InputError);
  }
}

TEST_CASE("what the solvability test refuses, the programs' methods themselves find unbounded") {
  problem::Clock clock;
  Monitor quiet;
  const auto find = [&](const Point& load, bool reduced) {
    const auto block = test::block("block", 2, mesh::Family::q1, 3, 0.25);
    test::pull(block, "top", [&](const Point&) { return load; });
    auto scene = scene::make_scene({block});
    scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
    const scene::Model model = scene::build(*scene, clock, quiet);
    const problem::RigidMotions rigid = problem::rigid_motions(model.problem);
    const solver::PrimalProgram primal(model.problem, rigid, "active_set", reduced, algebra::Ordering::automatic, clock, quiet);
    const program::QuadraticProgram& p = primal.program();
    program::ActiveSet settings;
    settings.start = program::ActiveSet::Start::cold;
    for (const program::Result& r : {program::solve(p, settings, quiet), program::solve(p, program::InteriorPoint{}, quiet)}) {
      CAPTURE(load[0]);
      CAPTURE(reduced);
      REQUIRE_MESSAGE(r.status == program::Status::unbounded, r.reason);
      // The proof: along it nothing resists, no row is met, and the load does work.
      CHECK(program::times(p.P, r.direction).norm() < 1e-6 * p.P.norm());
      CHECK((p.A * r.direction).maxCoeff() < 1e-6);
      CHECK(p.q.dot(r.direction) < -0.1 * p.q.norm() / std::sqrt(p.unknowns()));
    }
  };
  find({0.5, -1, 0}, false);  // slides along the floor for ever; no row notices, so that the reduced program does not know
  for (const bool reduced : {true, false}) find({0, 1, 0}, reduced);  // rises from it
}
