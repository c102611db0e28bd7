#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "algebra/dense/decompositions.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("unilateral, bilateral and elastic rows together, as the dense reference has them") {
  test::Random random(91);
  Monitor quiet;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 9;
    auto p = test::program(random.positive_definite(n, 0.5), 2 * random.vector(n), random.matrix(7, n),
                           0.3 * random.vector(7));
    std::vector<double> k(3), compliance(7, 0);
    for (int i = 0; i < 3; ++i) {
      k[i] = std::pow(10, random.between(-2, 3));
      compliance[4 + i] = 1 / k[i];
    }
    p.groups = {test::group(problem::unilateral(), 0, 3), test::group(problem::bilateral(), 3, 1),
                test::group(problem::elastic(k), 4, 3)};
    const auto exact = test::by_enumeration(p, compliance);
    REQUIRE(exact);
    std::vector<std::vector<char>> path;
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK((r.state.u.here() - exact->u.here()).norm() <= 1e-9 * exact->u.here().norm());
      CHECK((r.state.lambda - exact->lambda).norm() <= 1e-8 * exact->lambda.norm());
      const auto residual = problem::residual(p, r.state);
      CHECK(residual.equilibrium < 1e-11);
      CHECK(residual.law < 1e-9);
      if (reduced)
        path = r.active_sets;
      else
        CHECK(r.active_sets == path);
    }
  }
}

TEST_CASE("an elastic row is a spring added to the stiffness; without stiffness it is absent") {
  test::Random random(92);
  Monitor quiet;
  const int n = 5;
  const DenseMatrix K = random.positive_definite(n, 1);
  const Vector f = random.vector(n), b = random.vector(n);
  for (double k : {0.0, 1e-6, 1.0, 1e6}) {
    auto p = test::program(K, f, b.transpose(), Vector::Constant(1, 0.1));
    p.groups = {test::group(problem::elastic({k}), 0, 1)};
    const Vector exact = algebra::Ldlt(K + k * b * b.transpose()).solve(Vector(f + k * 0.1 * b));
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE(r.converged);
      CHECK((r.state.u.here() - exact).norm() < 1e-9 * exact.norm());
      CHECK(std::abs(r.state.lambda[0] - k * (b.dot(exact) - 0.1)) < 1e-8 * (1 + std::abs(r.state.lambda[0])));
    }
  }
}

TEST_CASE("a row that the law leaves to no unknown is harmless") {
  Monitor quiet;
  DenseMatrix B = DenseMatrix::Zero(2, 2);
  B(0, 0) = 1;
  const auto p = test::program(DenseMatrix::Identity(2, 2), Vector{{3, 1}}, B, Vector{{1, 0.5}});
  const auto r = solver::solve(p, test::pdas(true), quiet);
  REQUIRE(r.converged);
  CHECK((r.state.u.here() - Vector{{1, 1}}).norm() < 1e-14);
}
