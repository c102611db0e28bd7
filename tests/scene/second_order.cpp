// Contact of bodies of order 2: rows in the mean with the corners' hats, on nodes that match or not, beside order 1.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/stacks.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/proximal.hpp"

using namespace dotyk;
using contact::Pairing;
using mesh::Family;
using mesh::Point;
using test::kPressure;

TEST_CASE("the patch test of contact for every pair of elements, order 2 on either side: uniform pressure is exact") {
  for (int dim : {2, 3})
    for (const Family one : test::kAllFamilies)
      for (const Family other : test::kAllFamilies)
        for (const auto& [n, m] : {std::pair{2, 3}, {3, 2}, {2, 2}, {2, 4}})
          for (const bool upper_first : {true, false}) {
            if (!test::quadratic(one) && !test::quadratic(other)) continue;
            if (dim == 3 && (n + m == 6 || (n + m == 5 && upper_first == (n == 2)))) continue;  // time: the finer part first in one, the coarser in the other
            CAPTURE(dim);
            CAPTURE(test::name(one));
            CAPTURE(test::name(other));
            CAPTURE(n);
            test::Stack s = test::stack(dim, one, other, n, m);
            for (const auto& b : {s.low, s.high}) test::symmetric(b);
            test::slide(s.low, "bottom");
            test::press(s.high, "top", kPressure);
            test::touch(s, upper_first);
            CHECK((s.contact->pairing == Pairing::matching) == (n == m && test::quadratic(one) && test::quadratic(other) && (dim == 2 || one == other)));
            const auto solution = test::solve(s.scene);
            REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
            const auto result = solution->contact(*s.contact);
            CHECK(result.open == 0);
            CHECK(result.area == doctest::Approx(1).epsilon(1e-12));
            for (const auto& node : result.nodes) {
              CHECK(std::abs(node.pressure / kPressure - 1) < 1e-12);
              CHECK(std::abs(node.gap) < 1e-13);
            }
            for (int b : {0, 1})
              for (const auto& stress : solution->stress(b)) {
                CHECK(std::abs(stress[dim - 1] / kPressure + 1) < 1e-11);  // differences of displacements lose a digit
                CHECK(std::abs(stress[0]) < 1e-11 * kPressure);
                CHECK(std::abs(stress[dim == 2 ? 5 : 4]) < 1e-11 * kPressure);
              }
            const auto floor = solution->reaction(test::part(s.low, "bottom"));
            CHECK(std::abs(floor[dim - 1] - kPressure) < 1e-12 * kPressure);
            CHECK(std::abs(std::abs(result.force[dim - 1]) - kPressure) < 1e-12 * kPressure);
          }
}

TEST_CASE("friction of order 2, on nodes that match or not: action is reaction, node by node within the law") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder)
      for (const bool slips : {false, true})
        for (const int m : {2, 3}) {
          CAPTURE(test::name(family));
          CAPTURE(dim);
          test::Stack s = test::stack(dim, family, family, 2, m);
          test::fix(s.low, "bottom");
          auto top = test::part(s.high, "top");
          std::array<elasticity::ScalarField, 3> moved;
          moved[0] = [&](const Point&) { return slips ? 0.2 : 0.0005; };
          moved[dim - 1] = [](const Point&) { return -0.01; };
          if (dim == 3) moved[1] = [](const Point&) { return 0.0; };
          scene::displace(top, moved);
          test::touch(s, true, test::coulomb(0.3));
          const auto solution = test::solve_by(s.scene, solver::Newton{});
          REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
          const auto result = scene::as_given(*s.contact, solution->contact(*s.contact));
          CHECK(result.closed + result.stick + result.slip > 0);
          if (slips) CHECK(result.stick == 0);
          for (const auto& node : result.nodes) {
            const double shear = test::length(node.shear);
            CHECK(shear <= 0.3 * node.pressure * (1 + 1e-8) + 1e-10);
            if (node.status == problem::Status::slip) CHECK(mesh::dot(node.shear, node.slip) <= 1e-12);
          }
          if (slips && dim == 2) CHECK(-result.friction_force[0] == doctest::Approx(0.3 * result.force[1]).epsilon(1e-9));
          const auto floor = solution->reaction(test::part(s.low, "bottom")), held = solution->reaction(top);
          for (int i = 0; i < dim; ++i) {
            CHECK(std::abs(floor[i] + held[i]) < 1e-10 * std::abs(floor[dim - 1]));
            CHECK(std::abs(held[i] + result.force[i]) < 1e-10 * std::abs(floor[dim - 1]));
          }
        }
}

TEST_CASE("friction of order 2: methods agree, and fine cells of order 1 come near") {
  for (const bool tresca : {true, false}) {
    const auto make = [&](Family family, int n) {
      test::Stack s = test::stack(2, family, family, n, n);
      test::fix(s.low, "bottom");
      test::fix(s.high, "left");
      test::pull(s.high, "top", [](const Point& x) { return Point{0.4, -1 - x[0], 0}; });
      test::touch(s, true, tresca ? test::given(0.1) : test::coulomb(0.2));
      return s;
    };
    for (const Family family : test::kSecondOrder) {
      const test::Stack s = make(family, 6);
      const auto newton = test::solve_by(s.scene, solver::Newton{});
      solver::Proximal proximal;
      proximal.tol = 1e-12;
      proximal.max_iterations = 200000;
      solver::CoulombLoop loop;
      loop.tol = 1e-11;
      loop.inner = std::make_shared<solver::Proximal>(proximal);
      test::agree(tresca ? *test::solve_by(s.scene, proximal) : *test::solve_by(s.scene, loop), *newton, 1e-8);
      const auto mine = newton->contact(*s.contact);
      CHECK(mine.slip > 0);
      const test::Stack fine = make(Family::q1, 32);
      const auto solution = test::solve_by(fine.scene, solver::Newton{});
      REQUIRE(solution->result().converged);
      const auto theirs = solution->contact(*fine.contact);
      CHECK(mine.force[1] == doctest::Approx(theirs.force[1]).epsilon(0.01));
      CHECK(mine.friction_force[0] == doctest::Approx(theirs.friction_force[0]).epsilon(0.03));
      CHECK(newton->energy() == doctest::Approx(solution->energy()).epsilon(0.01));
    }
  }
}

TEST_CASE("glue for every pair of elements: linear displacements are exact") {
  for (int dim : {2, 3})
    for (const Family one : test::kAllFamilies)
      for (const Family other : test::kAllFamilies) {
        if (!test::quadratic(one) && !test::quadratic(other)) continue;
        CAPTURE(test::name(one));
        CAPTURE(test::name(other));
        test::Stack s = test::stack(dim, one, other, 2, 3, 210, 0.3);  // of one material: the stack is one body
        for (const auto& b : {s.low, s.high}) test::symmetric(b);
        test::slide(s.low, "bottom");
        test::pull(s.high, "top", [&](const Point&) { return test::axis(dim, 0, 2); });
        scene::add_glue(*s.scene, test::part(s.high, "bottom"), test::part(s.low, "top"));
        const auto solution = test::solve(s.scene);
        REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
        CHECK(solution->reaction(test::part(s.low, "bottom"))[dim - 1] == doctest::Approx(-2).epsilon(1e-11));
        for (int b : {0, 1})
          for (const auto& stress : solution->stress(b)) {
            CHECK(std::abs(stress[dim - 1] - 2) < 1e-10);
            CHECK(std::abs(stress[0]) < 1e-10);
          }
      }
}

TEST_CASE("nodes of order 2 that match: two glued halves are one body") {
  for (const Family family : test::kSecondOrder) {
    const auto load = [](const std::shared_ptr<scene::Body>& b) { test::pull(b, "top", [](const Point& x) { return Point{0.5 * x[1], 0.1 - x[0], 0}; }); };
    const auto whole = test::body("whole", test::rectangle(family, 3, 4, 0, 0, 1, 2));
    test::fix(whole, "bottom");
    load(whole);
    const auto one = test::solve(scene::make_scene({whole}));
    const auto low = test::body("low", test::rectangle(family, 3, 2)), high = test::body("high", test::rectangle(family, 3, 2, 0, 1, 1, 2));
    test::fix(low, "bottom");
    load(high);
    const auto scene = scene::make_scene({low, high});
    const auto glue = scene::add_glue(*scene, test::part(low, "top"), test::part(high, "bottom"));
    CHECK(glue->pairing == Pairing::matching);
    CHECK(glue->glued.size() == 7);  // every node, those between corners, too
    const auto two = test::solve(scene);
    for (int b : {0, 1})
      for (int n = 0; n < scene->bodies[b]->mesh->node_count(); ++n) {
        const Point u = one->displacement(0, scene->bodies[b]->mesh->point(n));
        for (int i : {0, 1}) CHECK(std::abs(two->displacement(b)[2 * n + i] - u[i]) < 1e-11);
      }
  }
}

TEST_CASE("a crack of order 2, in contact with itself: closed it carries the whole body's stress, its tip has no jump") {
  for (const Family family : test::kSecondOrder) {
    // A unit square slit along y = 1/2 from x = 0 to the middle: the nodes of the slit but its tip are doubled.
    mesh::Mesh m = test::rectangle(family, 4, 4);
    const mesh::ElementTopology t = m.topology();
    std::vector<int> twin(m.node_count(), -1);
    for (int n = 0, count = m.node_count(); n < count; ++n)
      if (m.node(n)[1] == 0.5 && m.node(n)[0] < 0.5) {
        const Point x = m.point(n);
        twin[n] = m.node_count();
        m.coordinates.insert(m.coordinates.end(), {x[0], x[1]});
      }
    for (int c = 0; c < m.cell_count(); ++c)
      if (m.cell_centre(c)[1] > 0.5)
        for (int k = 0; k < t.nodes; ++k) {
          int& n = m.cells[static_cast<std::size_t>(c) * t.nodes + k];
          if (twin[n] >= 0) n = twin[n];
        }
    for (const auto& [name, sign] : {std::pair{"lower", 1}, {"upper", -1}})
      m.parts[name] = mesh::select(m, [&, side = sign](const Point& x, const Point& normal) { return x[1] == 0.5 && normal[1] * side > 0.9; });
    REQUIRE(m.parts.at("lower").size() == 2);
    for (const bool pressed : {true, false}) {
      const auto body = test::body("plate", m);
      test::slide(body, "left");
      test::slide(body, "bottom");
      test::press(body, "top", pressed ? kPressure : -kPressure);
      const auto scene = scene::make_scene({body});
      const auto contact = scene::add_contact(*scene, test::part(body, "lower"), test::part(body, "upper"), {});
      const auto solution = test::solve(scene);
      REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
      const auto result = solution->contact(*contact);
      if (pressed) {
        CHECK(result.open == 0);
        for (const auto& node : result.nodes) CHECK(node.pressure == doctest::Approx(kPressure).epsilon(1e-10));
        for (const auto& stress : solution->stress(0)) CHECK(std::abs(stress[1] + kPressure) < 1e-9);
      } else {
        CHECK(result.closed == 0);
        double widest = 0;
        for (const auto& node : result.nodes) widest = std::max(widest, node.gap);
        CHECK(widest > 1e-3);
      }
    }
  }
}
