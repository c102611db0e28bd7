// What derivatives cost beside solving again, on two blocks of the size of P7's "cont" (41 × 21 nodes each, six variables) and
// of twice as many cells along each side. Prints seconds, so it is left out of ordinary runs:
//   test_shape -ns -tc="what derivatives cost"
#include "base/stopwatch.hpp"
#include "differences.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

// Prints timings, which depend on the machine, and asserts nothing about them: run by name (test_shape -ns -tc="what derivatives cost").
TEST_CASE("what derivatives cost" * doctest::skip()) {
  constexpr int kVariables = 6;
  for (const int n : {1, 2, 4}) {
    const auto lower = test::body("lower", test::rectangle(Family::q1, 40 * n, 20 * n, 0, 0, 4, 2), 1e5);
    const auto upper = test::body("upper", test::rectangle(Family::q1, 40 * n, 20 * n, 0, 2, 4, 4), 2.1e5);
    test::fix(lower, "bottom");
    test::fix(upper, "left", {true, false, false});
    test::press(upper, "top", 1000);
    const auto scene = scene::make_scene({lower, upper});
    scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"),
                       [](const Point& x) { return 0.002 * (x[0] - 2) * (x[0] - 2); }, {}, true);
    test::solved(scene);  // what is done once in a process
    const auto condenser = std::make_shared<problem::Condenser>();
    Stopwatch watch;
    const auto solution = test::solved(scene, condenser);
    const double solve = watch.lap();
    const auto s = test::sensitivity(solution, condenser);
    const double setup = watch.lap();
    std::vector<test::Velocities> V;
    for (int k = 0; k < kVariables; ++k) V.push_back(test::velocities(*scene, test::random_motion(0.01 / n, {true, true, true}, static_cast<unsigned>(k))));
    watch.lap();
    std::vector<shape::Change> changes;
    for (const auto& v : V) changes.push_back(s.change(v));
    const double change = watch.lap() / kVariables;
    std::vector<shape::Derivative> derivatives;
    for (const auto& c : changes) derivatives.push_back(s.along(c));
    const double along = watch.lap() / kVariables;
    const shape::Adjoint adjoint = s.adjoint(solution->model().problem.B.transpose() * solution->result().state.lambda, {});
    const double gradient = watch.lap();
    const auto moved = test::solved_at(*scene, V[0], 1e-4), back = test::solved_at(*scene, V[0], -1e-4);
    const double again = watch.lap() / 2;
    CHECK(test::apart((moved->result().state.u.here() - back->result().state.u.here()) / 2e-4, derivatives[0].u) < 1e-6);
    MESSAGE(solution->unknowns(), " unknowns, ", solution->rows(), " rows: solve ", solve, " s (at moved nodes ", again, "), setup ", setup,
            ", for each motion ", change, " + ", along, ", adjoint ", gradient, "; a motion costs 1/", again / (change + along), " of solving again");
    CHECK(std::abs(adjoint.along(changes[1]) - derivatives[1].u.dot(solution->model().problem.B.transpose() * solution->result().state.lambda)) <
          1e-9 * solution->result().state.lambda.norm());
  }
}
