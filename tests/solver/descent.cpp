#include "solver/active/descent.hpp"

#include <doctest/doctest.h>

#include "../support/programs.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("a sweep never increases the dual energy, keeps its jump, and sweeps converge to the solution") {
  test::Random random(81);
  Monitor quiet;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + trial % 6;
    auto p = test::program(random.positive_definite(n, 0.2), random.vector(n), DenseMatrix::Identity(n, n),
                           random.vector(n) * 0.2);
    // One law of each kind where there is room, with a row that has no stiffness.
    p.groups = {test::group(problem::unilateral(), 0, n - 1),
                test::group(problem::elastic({trial % 2 ? 3.0 : 0.0}), n - 1, 1)};
    problem::Clock clock;
    const problem::CondensedProblem condensed(p, problem::rigid_motions(p), algebra::Ordering::automatic, clock, quiet);
    solver::DualDescent descent(p, condensed, random.vector(n));
    REQUIRE(descent.lambda().allFinite());
    double q = descent.energy();
    for (int sweep = 0; sweep < 4000; ++sweep) {
      descent.sweep();
      CHECK(descent.energy() <= q + 1e-13 * std::abs(q));  // rounding of q itself
      q = descent.energy();
    }
    const Vector lambda = descent.lambda(), x = descent.jump();
    CHECK((x - condensed.jump(lambda, Vector())).norm() < 1e-9 * (x.norm() + 1));
    std::vector<double> compliance(n, 0);
    if (trial % 2 == 0) continue;  // enumeration has no row without stiffness
    compliance[n - 1] = 1 / 3.0;
    const auto exact = test::by_enumeration(p, compliance);
    REQUIRE(exact);
    CHECK((lambda - exact->lambda).norm() < 1e-7 * (1 + exact->lambda.norm()));
  }
}

TEST_CASE("with free bodies the augmented energy never increases between updates, and equilibrium is reached") {
  test::Random random(83);
  Monitor quiet;
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 3 + trial % 5;
    // A positive semidefinite stiffness whose kernel is the motion of all unknowns together, pressed
    // against obstacles above each of them.
    const DenseMatrix P = DenseMatrix::Identity(n, n) - DenseMatrix::Constant(n, n, 1.0 / n);
    const Vector f = random.vector(n) + Vector::Constant(n, 1.5);
    auto p =
        test::program(P * random.positive_definite(n, 0.2) * P, f, DenseMatrix::Identity(n, n), random.vector(n) * 0.2);
    p.blocks[0].kernel = DenseMatrix::Ones(n, 1);
    p.blocks[0].motions = {{.direction = {1}}};
    p.groups = {test::group(problem::unilateral(), 0, n)};
    problem::Clock clock;
    const problem::CondensedProblem condensed(p, problem::rigid_motions(p), algebra::Ordering::automatic, clock, quiet);
    solver::DualDescent descent(p, condensed, Vector::Zero(n));
    for (int update = 0; update < 400; ++update) {
      double q = descent.energy();
      for (int sweep = 0; sweep < 10; ++sweep) {
        descent.sweep();
        CHECK(descent.energy() <= q + 1e-13 * std::abs(q));
        q = descent.energy();
      }
      descent.update_equilibrium();
    }
    const Vector lambda = descent.lambda(), x = condensed.jump(lambda, descent.alpha());
    CHECK(std::abs(lambda.sum() - f.sum()) < 1e-9 * f.sum());
    CHECK(lambda.minCoeff() >= 0);
    CHECK(x.maxCoeff() < 1e-8);
    CHECK(std::abs(lambda.dot(x)) < 1e-8 * f.norm());
  }
}

TEST_CASE("admissible multipliers: the nearest ones, row by row") {
  test::Random random(82);
  auto p = test::program(DenseMatrix::Identity(4, 4), Vector::Zero(4), DenseMatrix::Identity(4, 4), Vector::Zero(4));
  p.groups = {test::group(problem::unilateral(), 0, 2), test::group(problem::bilateral(), 2, 1),
              test::group(problem::elastic({2}), 3, 1)};
  CHECK(solver::admissible(p, Vector{{-1, 1, -2, -3}}) == Vector{{0, 1, -2, -3}});
}
