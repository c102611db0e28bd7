// Bodies of order 2 by several methods: supports by laws, FETI.
#include <doctest/doctest.h>

#include "../support/laws.hpp"
#include "../support/stacks.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;
namespace laws = dotyk::problem::laws;

TEST_CASE("supports by laws of order 2: every method gives the same foundation, in the mean of the corners' hats") {
  for (const Family family : test::kSecondOrder)
    for (const problem::LawSpec* kind : {&laws::one_sided_elastic, &laws::capped_elastic, &laws::signorini, &laws::breaking}) {
      CAPTURE(test::name(family));
      const auto make = [&, limit = 1.9](Family f, int n) {
        auto m = test::rectangle(f, n, 2, 0, 0, 2, 1);
        const auto block = test::body("block", std::move(m), 50, 0.2);
        test::slide(block, "left");
        test::support(block, "bottom", {kind, 60, limit}, {&laws::friction, 0.05});
        test::pull(block, "top", [](const Point& x) { return Point{0.05, -2 + 1.6 * x[0], 0}; });
        test::springs(block, "right", {5, 20, 0});
        return scene::make_scene({block});
      };
      const auto scene = make(family, 6);
      const auto exact = test::solve_by(scene, solver::Newton{});
      REQUIRE_MESSAGE(exact->result().converged, exact->result().reason);
      CHECK(test::imbalance(*exact, {"bottom", "left", "right"}) < 1e-10);
      const auto result = exact->support(test::part(scene->bodies[0], "bottom"));
      CHECK(result.nodes.size() == 7);
      CHECK(result.closed + result.stick > 0);
      if (kind != &laws::capped_elastic && kind != &laws::breaking) CHECK(result.open > 0);
      CHECK(test::distance(*test::solve_by(scene, test::patient(solver::Proximal{})), *exact) < 1e-8);
      CHECK(test::distance(*test::solve_by(scene, test::feti(3)), *exact) < 1e-7);
      // Many small cells of order 1 give nearly the same forces and energy.
      const auto fine = test::solve_by(make(Family::q1, 48), solver::Newton{});
      REQUIRE(fine->result().converged);
      const auto theirs = fine->support(test::part(fine->scene().bodies[0], "bottom"));
      CHECK(result.force[1] == doctest::Approx(theirs.force[1]).epsilon(0.02));
      CHECK(exact->energy() == doctest::Approx(fine->energy()).epsilon(0.02));
    }
}

TEST_CASE("a support by a breaking law of order 2: all of it breaks at the bound, none below") {
  for (const Family family : test::kSecondOrder)
    for (const double load : {1.9, 2.1}) {
      const auto block = test::body("block", test::rectangle(family, 3, 2));
      test::symmetric(block);
      test::support(block, "bottom", {&laws::breaking, 40, 2.0});
      test::springs(block, "top", {0, 0.1, 0});  // 0.1/40 of the force
      test::press(block, "top", load);
      const auto s = test::solve(scene::make_scene({block}));
      REQUIRE(s->result().converged);
      const auto result = s->support(test::part(block, "bottom"));
      CHECK(result.nodes.size() == 4);
      CHECK(result.broken == (load > 2 ? 4 : 0));
      for (const auto& node : result.nodes) CHECK(node.pressure == doctest::Approx(load > 2 ? 0 : load).epsilon(0.005));
    }
}

TEST_CASE("FETI on cells of order 2 gives the direct method's solution") {
  using Preconditioner = solver::Feti::Preconditioner;
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder)
      for (const int m : {2, 3}) {
        test::Stack s = test::stack(dim, family, family, 2, m);
        test::fix(s.low, "bottom");
        test::fix(s.high, "left");
        test::pull(s.high, "top", [&](const Point& x) { return test::axis(dim, 0.2, -10 + 4 * x[0]); });
        test::touch(s);
        const auto exact = test::solve(s.scene);
        for (const auto preconditioner : {Preconditioner::none, Preconditioner::lumped, Preconditioner::dirichlet})
          for (const bool rows : {true, false}) {
            if (dim == 3 && (preconditioner == Preconditioner::lumped) != rows) continue;  // time
            test::agree(*test::solve_by(s.scene, test::feti(4, rows, preconditioner)), *exact, 1e-7);
          }
      }
}
