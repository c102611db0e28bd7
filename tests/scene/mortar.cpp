#include <doctest/doctest.h>

#include <numbers>

#include "../support/block_pair.hpp"
#include "../support/scenes.hpp"
#include "../support/stacks.hpp"
#include "base/error.hpp"
#include "scene/model/moved.hpp"

using namespace dotyk;
using contact::Pairing;
using mesh::Family;
using mesh::Point;
using test::Stack;
using test::kPressure;

namespace {

// The patch test's measure, relative to the pressure.
constexpr double kExact = 1e-11;

/// Blocks of n and m cells along each edge of their own on top of each other, turned by an angle in the plane of the first and
/// the last axis, free to widen; the upper one pressed. The upper's bottom is the first part, or the lower's top.
Stack stack(int dim, Family one, Family other, int n, int m, std::optional<Pairing> pairing, double angle = 0, bool upper_first = true,
            const scene::GivenLaw& friction = {}) {
  test::BlockPair blocks = test::block_pair(dim, one, other, n, m, angle);
  Stack s;
  s.low = test::body("low", std::move(blocks.low), 210, 0.3);
  s.high = test::body("high", std::move(blocks.high), 70, 0.2);
  for (const auto& b : {s.low, s.high}) test::symmetric(b);
  test::slide(s.low, "bottom");
  test::press(s.high, "top", kPressure);
  s.scene = scene::make_scene({s.low, s.high});
  test::touch(s, upper_first, friction, pairing);
  return s;
}

/// The greatest departure of contact pressures and nodal stresses from the uniform state, relative.
double departure(const Stack& s, const scene::Solution& solution, double angle = 0) {
  const int dim = s.low->dimension();
  double worst = 0;
  for (const auto& node : solution.contact(*s.contact).nodes) worst = std::max(worst, std::abs(node.pressure / kPressure - 1));
  const double up[2] = {-std::sin(angle), std::cos(angle)};
  for (int b : {0, 1})
    for (const auto& stress : solution.stress(b)) {
      const double xx = stress[0], hh = stress[dim - 1], xh = stress[dim == 2 ? 5 : 4];
      for (const double d : {xx / kPressure + up[0] * up[0], hh / kPressure + up[1] * up[1], xh / kPressure + up[0] * up[1]})
        worst = std::max(worst, std::abs(d));
    }
  return worst;
}

}  // namespace

TEST_CASE("the patch test on nodes that do not match: mortar passes, node to segment does not") {
  for (int dim : {2, 3})
    for (const Family one : test::kFamilies)
      for (const Family other : test::kFamilies)
        for (const auto& [n, m] : {std::pair{2, 3}, {3, 2}, {5, 7}})
          for (const bool upper_first : {true, false}) {
            if (dim == 3 && n == 5 && one != other) continue;  // time
            const Stack s = stack(dim, one, other, n, m, {}, 0, upper_first);
            CHECK(s.contact->pairing == Pairing::mortar);
            const auto solution = test::solve(s.scene);
            REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
            CHECK(departure(s, *solution) < kExact);
            const auto result = solution->contact(*s.contact);
            CHECK(result.open == 0);
            CHECK(result.area == doctest::Approx(1).epsilon(1e-12));
            for (const auto& node : result.nodes) CHECK(std::abs(node.gap) < 1e-13);
            const auto floor = solution->reaction(test::part(s.low, "bottom"));
            CHECK(std::abs(std::abs(result.force[dim - 1]) - kPressure) < 1e-12 * kPressure);
            CHECK(std::abs(floor[dim - 1] - kPressure) < 1e-12 * kPressure);
            const Stack feet = stack(dim, one, other, n, m, Pairing::node_to_segment, 0, upper_first);
            const auto uneven = test::solve(feet.scene);
            REQUIRE(uneven->result().converged);
            CHECK(departure(feet, *uneven) > 0.02);
            CHECK(std::abs(uneven->reaction(test::part(feet.low, "bottom"))[dim - 1] - kPressure) < 1e-12 * kPressure);  // forces balance still
          }
}

TEST_CASE("the same on a tilted interface") {
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      const Stack s = stack(dim, family, family, 4, dim == 2 ? 7 : 3, {}, 0.5);
      const auto solution = test::solve(s.scene);
      REQUIRE(solution->result().converged);
      CHECK(departure(s, *solution, 0.5) < 10 * kExact);  // slides along no axis are rows: a digit less
    }
}

TEST_CASE("an upper block that overhangs, and one that is narrower: what is covered bears the pressure") {
  // The part covered is loaded by p on top alone, the part beside it not: uniform stress below and above is no solution
  // then, but forces and moments balance.
  for (const Family family : test::kFamilies) {
    const auto low = test::body("low", test::rectangle(family, 5, 4, 0, 0, 1, 1)),
               high = test::body("high", test::rectangle(family, 4, 3, 0.37, 1, 1.37, 1.5));
    test::fix(low, "bottom");
    test::press(high, "top", kPressure);
    test::slide(high, "right");
    const auto scene = scene::make_scene({low, high});
    const auto contact = scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {});
    const auto solution = test::solve(scene);
    REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
    const auto result = solution->contact(*contact);
    CHECK(result.force[1] == doctest::Approx(kPressure).epsilon(1e-12));
    CHECK(solution->reaction(test::part(low, "bottom"))[1] == doctest::Approx(-result.force[1] + 2 * kPressure).epsilon(1e-12));
    for (const auto& node : result.nodes) {
      CHECK(node.pressure >= 0);
      CHECK(node.gap > -1e-12);
      CHECK(node.gap * node.pressure < 1e-12);
    }
  }
}

TEST_CASE("moments balance: the contact's forces on both bodies have one resultant and one moment") {
  for (const auto pairing : {Pairing::mortar, Pairing::node_to_segment}) {
    const auto low = test::body("low", test::rectangle(Family::p1, 7, 4, 0, 0, 1, 1)),
               high = test::body("high", test::rectangle(Family::q1, 5, 4, 0, 1, 1, 2), 70);
    test::fix(low, "bottom");
    test::pull(high, "top", [](const Point& x) { return Point{0, -1 - 2 * x[0], 0}; });
    test::slide(high, "left");
    const auto scene = scene::make_scene({low, high});
    const auto contact = scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {}, {}, false, {}, pairing);
    const auto solution = test::solve(scene);
    REQUIRE(solution->result().converged);
    const auto force = solution->model().contact_force(0, solution->result().state.lambda);
    const mesh::Mesh &here = *contact->first.body->mesh, &there = *contact->second.body->mesh;  // the part that has the rows is the first
    double ours = 0, theirs = 0, up = 0;
    for (std::size_t k = 0; k < force.size(); ++k) {
      up += force[k][1];
      ours += here.node(contact->rows[k].node)[0] * force[k][1];
      for (const auto& partner : contact->rows[k].partners) theirs += partner.weight * there.node(partner.node)[0] * force[k][1];
    }
    CHECK(up == doctest::Approx(&here == high->mesh.get() ? 2 : -2).epsilon(1e-12));
    CHECK(ours == doctest::Approx(theirs).epsilon(1e-12));
  }
}

TEST_CASE("on matching nodes mortar is the nodal contact, with friction too") {
  const scene::GivenLaw coulomb{problem::laws::coulomb, [](const Point&) { return 0.3; }};
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      std::vector<algebra::Vector> u;
      for (const auto pairing : {Pairing::matching, Pairing::mortar}) {
        Stack s = stack(dim, family, family, 4, 4, pairing, 0, true, coulomb);
        test::pull(s.high, "top", [](const Point& x) { return Point{0.2 + 0.4 * x[0], 0, 0}; });
        Monitor quiet;
        u.push_back(scene::solve(s.scene, solver::Newton{}, {}, quiet)->result().state.u.here());
      }
      CHECK((u[0] - u[1]).lpNorm<Eigen::Infinity>() < 1e-9 * u[0].lpNorm<Eigen::Infinity>());
    }
}

TEST_CASE("friction that sticks, on nodes that do not match: a uniform state with shear is exact") {
  // σ = −p along the last axis and τ on the planes of the first and last, of one material; E 210, ν 0.3.
  const double tau = 0.5, p = kPressure;
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      mesh::Mesh meshes[2] = {test::unit(dim, family, 3), test::unit(dim, family, dim == 2 ? 5 : 4)};
      mesh::transform(meshes[1], [&](Point x) { return x[dim - 1] += 1, x; });
      const auto low = test::body("low", std::move(meshes[0])), high = test::body("high", std::move(meshes[1]));
      const auto axis = [&](double x, double last) { return dim == 2 ? Point{x, last, 0} : Point{x, 0, last}; };
      for (const auto& b : {low, high}) {
        test::pull(b, "left", [&](const Point&) { return axis(0, -tau); });
        test::pull(b, "right", [&](const Point&) { return axis(0, tau); });
        if (dim == 3) test::slide(b, "front");
      }
      test::pull(high, "top", [&](const Point&) { return axis(tau, -p); });
      const double across = 0.3 * p / 210 * (dim == 2 ? 1.3 : 1);  // ε_xx
      std::array<elasticity::ScalarField, 3> given;
      given[0] = [&](const Point& x) { return across * x[0]; };
      if (dim == 3) given[1] = [&](const Point& x) { return across * x[1]; };
      given[dim - 1] = [](const Point&) { return 0.0; };
      auto bottom = test::part(low, "bottom");
      scene::displace(bottom, given);
      const auto scene = scene::make_scene({low, high});
      const auto contact = scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {},
                                              {problem::laws::coulomb, [](const Point&) { return 0.4; }});
      Monitor quiet;
      const auto solution = scene::solve(scene, solver::Newton{}, {}, quiet);
      REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
      const auto result = solution->contact(*contact);
      CHECK(result.stick == static_cast<int>(result.nodes.size()));
      // Newton's tolerance of 1e-10 or so, not the direct solve's rounding.
      for (const auto& node : result.nodes) CHECK(std::abs(node.pressure - p) < 1e-8);
      for (int b : {0, 1})
        for (const auto& stress : solution->stress(b)) {
          CHECK(std::abs(stress[dim - 1] + p) < 1e-8);
          CHECK(std::abs(stress[dim == 2 ? 5 : 4] - tau) < 1e-8);
          CHECK(std::abs(stress[0]) < 1e-8);
        }
    }
}

TEST_CASE("friction on nodes that do not match: sticks or slips as it is driven, action is reaction") {
  for (int dim : {2, 3})
    for (const bool slips : {false, true}) {
      mesh::Mesh meshes[2] = {test::unit(dim, Family::q1, 3), test::unit(dim, Family::q1, 4)};
      mesh::transform(meshes[1], [&](Point x) { return x[dim - 1] += 1, x; });
      const auto low = test::body("low", std::move(meshes[0])), high = test::body("high", std::move(meshes[1]));
      test::fix(low, "bottom");
      auto top = test::part(high, "top");
      std::array<elasticity::ScalarField, 3> given;
      given[0] = [&](const Point&) { return slips ? 0.2 : 0.001; };
      given[dim - 1] = [](const Point&) { return -0.01; };
      if (dim == 3) given[1] = [](const Point&) { return 0.0; };
      scene::displace(top, given);
      const auto scene = scene::make_scene({low, high});
      const auto contact = scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {},
                                              {problem::laws::coulomb, [](const Point&) { return 0.3; }});
      Monitor quiet;
      const auto solution = scene::solve(scene, solver::Newton{}, {}, quiet);
      REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
      const auto result = scene::as_given(*contact, solution->contact(*contact));
      CHECK(result.open == 0);
      CHECK((slips ? result.stick : result.slip) == 0);
      // In space the shear of single nodes points a little sideways.
      if (slips) CHECK(-result.friction_force[0] == doctest::Approx(0.3 * result.force[dim - 1]).epsilon(dim == 2 ? 1e-9 : 0.01));
      // Action is reaction, in both directions.
      const auto floor = solution->reaction(test::part(low, "bottom")), held = solution->reaction(top);
      for (int i = 0; i < dim; ++i) {
        CHECK(std::abs(floor[i] + held[i]) < 1e-11 * std::abs(floor[dim - 1]));
        CHECK(std::abs(held[i] + result.force[i]) < 1e-11 * std::abs(floor[dim - 1]));
      }
    }
}

TEST_CASE("glue on nodes that do not match: linear displacements are exact") {
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      mesh::Mesh meshes[2] = {test::unit(dim, family, 3), test::unit(dim, family, 4)};
      mesh::transform(meshes[1], [&](Point x) { return x[dim - 1] += 1, x; });
      const auto low = test::body("low", std::move(meshes[0])), high = test::body("high", std::move(meshes[1]));
      for (const auto& b : {low, high}) test::symmetric(b);
      test::slide(low, "bottom");
      test::pull(high, "top", [&](const Point&) { return dim == 2 ? Point{0, 2, 0} : Point{0, 0, 2}; });
      const auto scene = scene::make_scene({low, high});
      const auto glue = scene::add_glue(*scene, test::part(high, "bottom"), test::part(low, "top"));
      CHECK(glue->pairing == Pairing::mortar);
      const auto solution = test::solve(scene);
      REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
      for (int b : {0, 1})
        for (const auto& stress : solution->stress(b)) CHECK(std::abs(stress[dim - 1] - 2) < 1e-10);
      CHECK_NOTHROW(solution->error_estimate());
    }
}

TEST_CASE("every way to solve treats mortar rows alike") {
  const Stack s = stack(2, Family::p1, Family::p1, 8, 6, {});
  const auto exact = test::solve(s.scene)->result().state.u.here();
  for (const bool reduced : {true, false})
    CHECK((test::solve(s.scene, reduced)->result().state.u.here() - exact).lpNorm<Eigen::Infinity>() < 1e-11 * exact.lpNorm<Eigen::Infinity>());
  Monitor quiet;
  const auto feti = scene::solve(s.scene, test::feti(4), {}, quiet);
  REQUIRE_MESSAGE(feti->result().converged, feti->result().reason);
  CHECK((feti->result().state.u.here() - exact).lpNorm<Eigen::Infinity>() < 1e-5 * exact.lpNorm<Eigen::Infinity>());  // its tolerance
  CHECK(feti->contact(*s.contact).force[1] == doctest::Approx(kPressure).epsilon(1e-5));
}

TEST_CASE("the error estimate of a uniform state is rounding, where contact does not match too") {
  for (int dim : {2, 3})
    for (const bool upper_first : {true, false}) {
      const Stack s = stack(dim, Family::p1, Family::p1, 3, 4, {}, 0, upper_first);
      CHECK(test::solve(s.scene)->error_estimate().relative < 1e-5);
    }
}

TEST_CASE("what needs matching nodes says so") {
  const Stack s = stack(2, Family::p1, Family::p1, 3, 4, {});
  CHECK_THROWS_WITH_AS(scene::moved(*s.scene, {s.low->mesh->coordinates, {}}), doctest::Contains("only where nodes match"), InputError);
  CHECK_THROWS_WITH_AS(stack(2, Family::p1, Family::p1, 3, 4, Pairing::matching), doctest::Contains("do not match"), InputError);
  const auto scene = scene::make_scene({s.low, s.high});
  scene::Discretisation p1_p0;
  p1_p0.multipliers = contact::Multipliers::p1_p0;
  CHECK_THROWS_WITH_AS(scene::add_contact(*scene, test::part(s.low, "top"), test::part(s.high, "bottom"), {}, {}, false, p1_p0),
                       doctest::Contains("for matching nodes"), InputError);
}
