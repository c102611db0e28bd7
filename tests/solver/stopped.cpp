#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Asks to stop once so many questions have been asked.
struct StopAfter : Monitor {
  explicit StopAfter(int questions) : left(questions) {}
  bool stop() override { return left-- <= 0; }
  int left;
};

problem::Problem slow() {
  // A string over an obstacle: the contact set shrinks by a node an iteration.
  const int n = 30;
  DenseMatrix K = DenseMatrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    if (i) K(i, i - 1) = K(i - 1, i) = -1;
  }
  return test::program(K, Vector::Ones(n), DenseMatrix::Identity(n, n), Vector::LinSpaced(n, 0, 5));
}

}  // namespace

TEST_CASE("too few iterations: not converged, with a reason that names rows, and a state in equilibrium") {
  Monitor quiet;
  for (const bool reduced : {true, false}) {
    const auto enough = solver::solve(slow(), test::pdas(reduced), quiet);
    REQUIRE(enough.converged);
    REQUIRE(enough.iterations > 3);
    for (int most = 0; most < enough.iterations; ++most) {
      auto settings = test::pdas(reduced);
      settings.max_iterations = most;
      const auto p = slow();
      const auto r = solver::solve(p, settings, quiet);
      CHECK_FALSE(r.converged);
      CHECK(r.iterations == most);
      CHECK(r.reason.find("no confirmed active set within " + std::to_string(most) + " iterations") == 0);
      REQUIRE(r.state.u.size() == p.unknowns());
      REQUIRE(r.state.lambda.size() == p.rows());
      if (most == 0) continue;
      CHECK(r.reason.find("row ") != std::string::npos);
      CHECK(problem::residual(p, r.state).equilibrium < 1e-12);
    }
  }
}

TEST_CASE("an interrupted solve returns its state so far, or throws where there is none") {
  int interrupted = 0, finished = 0;
  for (const bool reduced : {true, false})
    for (int questions = 0; questions < 12; ++questions) {
      StopAfter monitor(questions);
      const auto p = slow();
      try {
        const auto r = solver::solve(p, test::pdas(reduced), monitor);
        if (!r.converged) CHECK(r.reason == "interrupted; this is the state so far");
        ++(r.converged ? finished : interrupted);
        REQUIRE(r.state.u.size() == p.unknowns());
        REQUIRE(r.state.lambda.size() == p.rows());
        if (r.iterations > 0) CHECK(problem::residual(p, r.state).equilibrium < 1e-12);
      } catch (const Interrupted&) {
        CHECK(questions < 9);  // there is none before rigid motions, factorisation and condensation are over, which ask, too
      }
    }
  CHECK(interrupted > 3);
  CHECK(finished > 3);
}
