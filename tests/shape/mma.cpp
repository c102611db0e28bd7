#include "shape/optimise/optimiser.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "base/error.hpp"
#include "designs.hpp"

using namespace dotyk;
using shape::Mma;
using shape::Optimum;
using test::KnownDesign;
using test::Vector;

namespace {

const Mma::Method kMethods[] = {Mma::Method::mma, Mma::Method::ccsaq, Mma::Method::slsqp};

Optimum run(const KnownDesign& k, Mma::Method method, int designs = 400) {
  Monitor nobody;
  Mma s;
  s.method = method, s.tol_design = 1e-7, s.tol_gap = 1e-9, s.tol_violation = 1e-9, s.max_designs = designs;
  return shape::minimise(k.problem, k.start, s, nobody);
}

}  // namespace

TEST_CASE("methods of NLopt find the known designs with their multipliers") {
  for (const auto method : kMethods) {
    CAPTURE(static_cast<int>(method));
    for (const KnownDesign& k : {test::vertex(), test::rosen_suzuki(), test::cantilever(), test::rosenbrock()}) {
      const Optimum o = run(k, method);
      CHECK(o.converged);
      CHECK(o.value.objective == doctest::Approx(k.minimum).epsilon(1e-5));
      CHECK(test::largest_difference(o.alpha, k.solution) < 5e-3);  // flat near the minimum: the objective is within 1e-5 of it
      if (k.multipliers.size() > 0) CHECK(test::largest_difference(o.multipliers, k.multipliers) < 1e-2);
      for (const auto& r : o.history)
        if (r.accepted && r.design > 1 && r.constraints.size() > 0) CHECK(r.objective >= k.minimum - 1e-6);
    }
  }
}

TEST_CASE("designs that are not admissible are stepped back from, with constraints and without") {
  for (const auto method : kMethods) {
    CAPTURE(static_cast<int>(method));
    KnownDesign k = test::cantilever();
    const auto beam = k.problem.evaluate;
    k.problem.evaluate = [&](const Vector& x) { return x[4] < 2.1 ? std::nullopt : beam(x); };
    const Optimum o = run(k, method);
    CHECK(o.alpha[4] >= 2.1);
    CHECK(o.value.objective == doctest::Approx(k.minimum).epsilon(1e-4));
    k = test::rosenbrock();
    const auto valley = k.problem.evaluate;
    k.problem.evaluate = [&](const Vector& x) { return x[1] < 0.1 && x[0] < 0 ? std::nullopt : valley(x); };
    k.start = test::vec({-0.6, 0.4});
    const Optimum p = run(k, method);
    for (const auto& r : p.history)
      if (r.accepted) CHECK(r.admissible);
    CHECK(p.value.objective < k.problem.evaluate(k.start)->objective);
  }
}

TEST_CASE("a step that is short because designs farther on are not admissible is no convergence") {
  for (const auto method : kMethods) {
    CAPTURE(static_cast<int>(method));
    KnownDesign k = test::rosenbrock();
    const auto valley = k.problem.evaluate;
    k.problem.evaluate = [&](const Vector& x) { return test::largest_difference(x, k.start) > 1e-5 ? std::nullopt : valley(x); };
    Monitor nobody;
    Mma s;
    s.method = method, s.tol_design = 1e-4;
    const Optimum o = shape::minimise(k.problem, k.start, s, nobody);
    CHECK_FALSE(o.converged);
    CHECK(o.gap > 1e-3);
    CHECK(o.reason.rfind("designs farther on are not admissible", 0) == 0);
  }
}

TEST_CASE("stopped, limited and failing runs leave NLopt in order") {
  const KnownDesign k = test::cantilever();
  for (const auto method : kMethods) {
    test::StopAfter five(5);
    const Optimum stopped = shape::minimise(k.problem, k.start, [&] { Mma s; s.method = method; return s; }(), five);
    CHECK_FALSE(stopped.converged);
    CHECK(stopped.history.size() == 6);
    CHECK(stopped.reason.rfind("stopped", 0) == 0);
    CHECK(run(k, method, 4).history.size() == 4);
    CHECK(run(k, method, 1).history.size() == 1);
    KnownDesign failing = k;
    int asked = 0;
    failing.problem.evaluate = [&](const Vector& x) { return ++asked < 4 ? k.problem.evaluate(x) : throw std::logic_error("mine"); };
    CHECK_THROWS_WITH_AS(run(failing, method), "mine", std::logic_error);
    CHECK(asked == 4);
    asked = 0;
    failing.problem.evaluate = [&](const Vector& x) { return ++asked < 7 ? k.problem.evaluate(x) : throw Interrupted(); };
    const Optimum interrupted = run(failing, method);
    CHECK(interrupted.reason.rfind("stopped", 0) == 0);
    CHECK(interrupted.history.size() == 6);
    CHECK(interrupted.alpha == stopped.alpha);
    failing.problem.evaluate = [](const Vector&) { return std::nullopt; };
    CHECK_THROWS_AS(run(failing, method), InputError);
  }
}

TEST_CASE("variables with one value stay; a first design that is optimal is the last") {
  KnownDesign k = test::cantilever();
  k.problem.lower[1] = k.problem.upper[1] = k.start[1];
  for (const auto method : kMethods)
    for (const auto& r : run(k, method).history) CHECK(r.alpha[1] == k.start[1]);
  k = test::vertex();
  k.start = k.solution;
  for (const auto method : kMethods) {
    const Optimum o = run(k, method);
    CHECK(o.converged);
    CHECK(o.history.size() == 1);
  }
}
