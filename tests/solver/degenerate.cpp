#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("rows that touch without force do not oscillate") {
  test::Random random(101);
  Monitor quiet;
  for (const double force : {1e-9, 1.0, 1e9})
    for (int trial = 0; trial < 60; ++trial) {
      const int n = 8;
      const DenseMatrix K = force * random.positive_definite(n, 0.3);
      // u = c and λ = 0 on some rows, both signs elsewhere.
      const Vector u = random.vector(n);
      Vector c = u, lambda = Vector::Zero(n);
      for (int i = 0; i < n; ++i) {
        const int kind = random.below(3);
        if (kind == 1) lambda[i] = force * random.between(0.1, 1);
        if (kind == 2) c[i] += random.between(0.1, 1);
      }
      const auto p = test::program(K, K * u + lambda, DenseMatrix::Identity(n, n), c);
      for (const bool reduced : {true, false}) {
        const auto r = solver::solve(p, test::pdas(reduced), quiet);
        REQUIRE_MESSAGE(r.converged, r.reason);
        CHECK(r.iterations < 30);
        CHECK((r.state.u.here() - u).norm() < 1e-10 * u.norm());
        CHECK((r.state.lambda - lambda).norm() < 1e-10 * force);
      }
    }
}

TEST_CASE("all rows touch and none carries a force: only rounding is left") {
  test::Random random(102);
  Monitor quiet;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 8;
    const DenseMatrix K = random.positive_definite(n, 0.3);
    const Vector u = random.vector(n);
    const auto p = test::program(K, K * u, DenseMatrix::Identity(n, n), u);
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK(r.iterations < 5);
      CHECK((r.state.u.here() - u).norm() < 1e-11 * u.norm());
      CHECK(r.state.lambda.norm() < 1e-11);
    }
  }
}

TEST_CASE("gaps that mean never do not blur the rows that matter") {
  test::Random random(104);
  Monitor quiet;
  for (const double never : {1e3, 1e9, 1e15, 1e30})
    for (int trial = 0; trial < 40; ++trial) {
      const int n = 7;
      auto p = test::program(random.positive_definite(n, 0.3), random.vector(n), DenseMatrix::Identity(n, n),
                             0.1 * random.vector(n));
      p.c[3] = p.c[5] = 1e3;
      const auto exact = test::by_enumeration(p);
      REQUIRE(exact);
      p.c[3] = p.c[5] = never;
      for (const bool reduced : {true, false}) {
        const auto r = solver::solve(p, test::pdas(reduced), quiet);
        REQUIRE_MESSAGE(r.converged, r.reason);
        CHECK((r.state.u.here() - exact->u.here()).norm() < 1e-9 * exact->u.here().norm());
      }
    }
}

TEST_CASE("nothing loaded: one solve, exact zeros") {
  Monitor quiet;
  const auto p =
      test::program(DenseMatrix::Identity(3, 3), Vector::Zero(3), DenseMatrix::Identity(3, 3), Vector::Zero(3));
  const auto r = solver::solve(p, test::pdas(true), quiet);
  CHECK(r.converged);
  CHECK(r.iterations == 1);
  CHECK(r.state.u.here().norm() + r.state.lambda.norm() == 0);
}

TEST_CASE("dependent rows survive: a duplicate, its multiple, bilateral ones, and the sum of two") {
  test::Random random(103);
  Monitor quiet;
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 6;
    const DenseMatrix K = random.positive_definite(n, 0.5);
    const Vector f = 2 * random.vector(n);
    DenseMatrix B = random.matrix(4, n);
    Vector c = 0.2 * random.vector(4).cwiseAbs();
    const auto plain = solver::solve(test::program(K, f, B, c), test::pdas(true), quiet);
    REQUIRE(plain.converged);
    B.conservativeResize(7, n);
    c.conservativeResize(7);
    B.row(4) = B.row(1), c[4] = c[1];
    B.row(5) = 3 * B.row(2), c[5] = 3 * c[2];
    B.row(6) = B.row(0) + B.row(1), c[6] = c[0] + c[1];
    const auto p = test::program(K, f, B, c);
    const auto r = solver::solve(p, test::pdas(true), quiet);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK((r.state.u.here() - plain.state.u.here()).norm() < 1e-8 * plain.state.u.here().norm());
    CHECK(problem::residual(p, r.state).equilibrium < 1e-8);
    CHECK(problem::residual(p, r.state).law < 1e-7);
  }
  // The same condition said twice as bilateral rows, beside a unilateral one.
  const DenseMatrix K = random.positive_definite(4, 1), B = random.matrix(2, 4);
  DenseMatrix twice(3, 4);
  twice << B, B.row(1);
  auto p = test::program(K, Vector::Ones(4), twice, Vector{{0.1, 0.2, 0.2}});
  p.groups = {test::group(problem::unilateral(), 0, 1), test::group(problem::bilateral(), 1, 2)};
  const auto r = solver::solve(p, test::pdas(true), quiet);
  REQUIRE(r.converged);
  CHECK(problem::residual(p, r.state).law < 1e-10);
  CHECK(r.state.lambda[1] == doctest::Approx(r.state.lambda[2]));
}

TEST_CASE("bilateral rows that contradict each other have no solution and say so") {
  Monitor quiet;
  DenseMatrix B(2, 2);
  B << 1, 0, 1, 0;
  auto p = test::program(DenseMatrix::Identity(2, 2), Vector::Ones(2), B, Vector{{0.1, 0.2}});
  p.groups = {test::group(problem::bilateral(), 0, 2)};
  for (const bool reduced : {true, false}) {
    const auto r = solver::solve(p, test::pdas(reduced), quiet);
    CHECK_FALSE(r.converged);
    CHECK(r.reason.find("active rows contradict each other") != std::string::npos);
    CHECK(r.state.u.size() == 2);
    CHECK(r.state.lambda.size() == 2);
    CHECK(r.state.u.here().allFinite());
  }
}
