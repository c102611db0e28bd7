#include "shape/optimise/optimiser.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "base/error.hpp"
#include "designs.hpp"

using namespace dotyk;
using shape::Optimum;
using shape::Slp;
using test::KnownDesign;
using test::vec;
using test::Vector;

namespace {

Optimum run(const KnownDesign& k, Slp settings = {}) {
  Monitor nobody;
  return shape::minimise(k.problem, k.start, settings, nobody);
}

Slp fine(int designs = 100) {
  Slp s;
  s.tol_design = 1e-6, s.tol_gap = 1e-9, s.tol_violation = 1e-9, s.max_designs = designs;
  return s;
}

}  // namespace

TEST_CASE("at a vertex sequential linear programming converges quadratically, with the constraints' multipliers") {
  const KnownDesign k = test::vertex();
  const Optimum o = run(k, fine());
  CHECK(o.converged);
  CHECK(test::largest_difference(o.alpha, k.solution) < 1e-9);
  CHECK(test::largest_difference(o.multipliers, k.multipliers) < 1e-6);
  CHECK(o.value.objective == doctest::Approx(k.minimum));
  CHECK(o.history.size() <= 9);  // four to come near in boxes of 0.1, 0.2, 0.4, 0.8; 1e-2, 1e-4, 1e-8 after
  std::vector<double> errors;
  for (const auto& r : o.history)
    if (r.accepted) errors.push_back(test::largest_difference(r.alpha, k.solution));
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    if (errors[i] < 0.1) CHECK(errors[i + 1] < 2 * errors[i] * errors[i] + 1e-14);  // Newton's method on two quadratic equations
}

TEST_CASE("where the minimum is curved the box shrinks, and it is found all the same") {
  for (const KnownDesign& k : {test::rosen_suzuki(), test::cantilever()}) {
    const Optimum o = run(k, fine());
    CHECK(o.converged);
    // Within a box of 1e-6 of the range, the last in which the linear model was of use, times a condition of some tens.
    CHECK(test::largest_difference(o.alpha, k.solution) < 1e-4);
    CHECK(test::largest_difference(o.multipliers, k.multipliers) < 1e-3);
    CHECK(o.value.objective == doctest::Approx(k.minimum).epsilon(1e-8));
    CHECK(o.history.size() < 80);
  }
}

TEST_CASE("down Rosenbrock's valley to the side of its box") {
  const KnownDesign k = test::rosenbrock();
  const Optimum o = run(k, fine(1000));
  CHECK(o.converged);
  CHECK(test::largest_difference(o.alpha, k.solution) < 1e-5);
}

TEST_CASE("the gap bounds what is left of a convex objective from above, and the objective falls from one accepted design to the next") {
  const KnownDesign k = test::cantilever();  // convex, scale of gaps: Σ x_i (first design) = 25, or Σ range = 45
  const Optimum o = run(k, fine());
  double last = INFINITY;
  for (const auto& r : o.history)
    if (r.accepted && r.constraints[0] <= 0) {
      CHECK(r.objective - k.minimum <= 45 * r.gap * (1 + 1e-9) + 1e-9);
      CHECK(r.objective <= last);
      last = r.objective;
    }
}

TEST_CASE("units of variables, objective and constraints change nothing") {
  const KnownDesign k = test::cantilever();
  const Optimum a = run(k), b = run(test::in_units(k, 1e-3, 1e6, 1e-4));
  REQUIRE(a.history.size() == b.history.size());
  for (std::size_t i = 0; i < a.history.size(); ++i) {
    CHECK(test::largest_difference(a.history[i].alpha, 1e3 * b.history[i].alpha) < 1e-6);
    CHECK(a.history[i].accepted == b.history[i].accepted);
  }
  CHECK(b.multipliers[0] == doctest::Approx(1e10 * a.multipliers[0]).epsilon(1e-5));
}

TEST_CASE("a start that violates the constraints is led back to them") {
  KnownDesign k = test::cantilever();
  k.start = Vector::Constant(5, 1.5);  // deflection 37 times too great
  const Optimum o = run(k, fine());
  CHECK(o.converged);
  CHECK(test::largest_difference(o.alpha, k.solution) < 1e-4);
}

TEST_CASE("contradictory constraints end at the least violation, not converged, and the reason says so") {
  KnownDesign k{{vec({-2, -2}), vec({2, 2}), {}}, vec({1.5, 1}), {}, {}, 0};
  k.problem.evaluate = [](const Vector& a) -> std::optional<shape::Evaluation> {
    shape::Evaluation e{a[1], vec({0, 1}), vec({1 + a[0] * a[0] - a[1], a[1] + 1}), shape::DenseMatrix(2, 2)};  // y ≥ 1 + x² and y ≤ −1
    e.jacobian << 2 * a[0], -1, 0, 1;
    return e;
  };
  const Optimum o = run(k);
  CHECK_FALSE(o.converged);
  CHECK(o.reason.find("constraints are violated") != std::string::npos);
  CHECK(std::abs(o.alpha[0]) < 0.1);
}

TEST_CASE("designs that are not admissible are stepped back from") {
  KnownDesign k = test::cantilever();
  const auto all = k.problem.evaluate;
  int refused = 0;
  k.problem.evaluate = [&](const Vector& x) { return x[4] < 2.1 ? ++refused, std::nullopt : all(x); };  // the minimum is at 2.153
  const Optimum o = run(k, fine(200));
  CHECK(o.converged);
  CHECK(refused > 0);
  CHECK(test::largest_difference(o.alpha, k.solution) < 1e-4);
  for (const auto& r : o.history) CHECK(r.admissible == (r.alpha[4] >= 2.1));

  k.problem.evaluate = [&](const Vector& x) { return x[4] < 3 ? std::nullopt : all(x); };  // the minimum is beyond
  const Optimum edge = run(k);
  CHECK_FALSE(edge.converged);
  CHECK(edge.reason.rfind("designs farther on are not admissible", 0) == 0);
  CHECK(edge.alpha[4] >= 3);
}

TEST_CASE("a kink with one-sided gradients is found by the shrinking box") {
  KnownDesign k{{vec({-1, -1}), vec({1, 1}), {}}, vec({-0.8, 0.9}), vec({0.3, -0.2}), Vector(), 0};
  k.problem.evaluate = [](const Vector& a) -> std::optional<shape::Evaluation> {
    const double x = a[0] - 0.3, y = a[1] + 0.2;
    return shape::Evaluation{std::abs(x) + 3 * std::abs(y), vec({x < 0 ? -1. : 1., y < 0 ? -3. : 3.}), Vector(), shape::DenseMatrix(0, 2)};
  };
  const Optimum o = run(k, fine(200));
  CHECK_FALSE(o.converged);  // the gap is that of one side
  CHECK(o.reason.starts_with("the design changes by less than tol_design; but"));
  CHECK(test::largest_difference(o.alpha, k.solution) < 1e-5);
}

TEST_CASE("stopped runs return the best design, and go on from there to the same end") {
  const KnownDesign k = test::cantilever();
  test::StopAfter five(5);
  const Optimum first = shape::minimise(k.problem, k.start, fine(), five);
  CHECK_FALSE(first.converged);
  CHECK(first.reason.rfind("stopped", 0) == 0);
  CHECK(first.history.size() == 6);
  KnownDesign rest = k;
  rest.start = first.alpha;
  Slp settings = fine();
  settings.radius = first.radius;
  const Optimum second = run(rest, settings);
  CHECK(second.converged);
  CHECK(test::largest_difference(second.alpha, k.solution) < 1e-4);
  KnownDesign interrupted = k;  // within a design
  int asked = 0;
  interrupted.problem.evaluate = [&](const Vector& x) { return ++asked < 7 ? k.problem.evaluate(x) : throw Interrupted(); };
  const Optimum until = run(interrupted, fine());
  CHECK(until.history.size() == 6);
  CHECK(until.reason.rfind("stopped", 0) == 0);
  CHECK(until.alpha == first.alpha);
  CHECK(until.radius == first.radius);
  interrupted.problem.evaluate = k.problem.evaluate;
  interrupted.problem.each = [](const shape::DesignRecord& d) { if (d.design == 6) throw Interrupted(); };
  CHECK(run(interrupted, fine()).alpha == first.alpha);
  const Optimum few = run(k, [] { Slp s; s.max_designs = 4; return s; }());
  CHECK_FALSE(few.converged);
  CHECK(few.history.size() == 4);
  CHECK(few.reason.find("no more than 4 designs were allowed") == 0);
}

TEST_CASE("variables with one value stay, and every design is told of once") {
  KnownDesign k = test::cantilever();
  k.problem.lower[1] = k.problem.upper[1] = k.start[1];
  std::vector<int> told;
  k.problem.each = [&](const shape::DesignRecord& r) {
    told.push_back(r.design);
    CHECK(r.alpha[1] == k.start[1]);
  };
  const Optimum o = run(k);
  CHECK(o.converged);
  REQUIRE(told.size() == o.history.size());
  for (std::size_t i = 0; i < told.size(); ++i) CHECK(told[i] == static_cast<int>(i) + 1);
}

TEST_CASE("what the evaluation throws is thrown; problems that are none are refused") {
  KnownDesign k = test::vertex();
  const auto good = k.problem.evaluate;
  k.problem.evaluate = [&](const Vector& a) { return a == k.start ? good(a) : throw std::logic_error("mine"); };
  CHECK_THROWS_WITH_AS(run(k), "mine", std::logic_error);
  k.problem.evaluate = [&](const Vector&) { return std::nullopt; };
  CHECK_THROWS_WITH_AS(run(k), "the first design is not admissible: start from one that is", InputError);
  k.problem.evaluate = [&](const Vector& a) {
    auto e = good(a);
    e->gradient[0] = NAN;
    return e;
  };
  CHECK_THROWS_AS(run(k), InputError);
  k = test::vertex();
  k.start[0] = 3;
  CHECK_THROWS_WITH_AS(run(k), "design variable 1 starts at 3, outside its bounds 0 and 2", InputError);
  k = test::vertex();
  k.problem.upper[1] = INFINITY;
  CHECK_THROWS_AS(run(k), InputError);
  k = test::vertex();
  CHECK_THROWS_AS(run(k, [] { Slp s; s.radius = 0; return s; }()), InputError);
}
