#include "solver/active/relaxed.hpp"

#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/core/default_method.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Two unilateral rows, two points that stick or slip under given bounds, and one under a bound that follows the first row.
problem::Problem random_problem(test::Random& random) {
  constexpr int kUnknowns = 24, kRows = 8;
  DenseMatrix B = DenseMatrix::Zero(kRows, kUnknowns);
  for (int r = 0; r < kRows; ++r) B(r, 2 * r) = random.between(0.5, 1.5), B(r, 2 * r + 1) = r % 2 ? random.between(-1, 1) : 0;  // odd rows act on two unknowns
  Vector c = Vector::Zero(kRows);
  c.head(2) = 0.1 * random.vector(2);
  auto p = test::program(random.positive_definite(kUnknowns, 0.3), random.vector(kUnknowns), B, c);
  p.groups = {test::group(problem::unilateral(), 0, 2)};
  p.friction = {{"given", problem::tresca({0.02, 0.3}), 2, 2, {-1, -1}}, {"following", problem::coulomb({0.3}), 6, 2, {0}}};
  return p;
}

}  // namespace

TEST_CASE("sweeps over all unknowns leave a solution as it is, and end there from elsewhere") {
  test::Random random(506);
  Monitor quiet;
  int bear = 0, slip = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const problem::Problem p = random_problem(random);
    const solver::HeldStiffness stiffness(p, problem::rigid_motions(p), solver::factor(algebra::Ordering::automatic), quiet);
    const solver::Result exact = solver::solve(p, {}, {}, quiet);
    REQUIRE(exact.converged);
    for (int r = 0; r < 2; ++r) bear += exact.state.lambda[r] > 0;
    slip += (p.B * exact.state.u.here()).segment(2, 2).norm() > 1e-6;
    const auto apart = [&](const problem::State& s) {
      return (s.u.here() - exact.state.u.here()).norm() / exact.state.u.here().norm() + (s.lambda - exact.state.lambda).norm() / exact.state.lambda.norm();
    };
    CHECK(apart(solver::relaxed(p, stiffness, exact.state).value()) < 1e-8);
    problem::State s{exact.state.u.here() + 0.02 * exact.state.u.here().lpNorm<Eigen::Infinity>() * random.vector(p.unknowns()), 0.95 * exact.state.lambda};
    CHECK(apart(s) > 1e-3);
    for (int k = 0; k < 200; ++k) s = solver::relaxed(p, stiffness, s).value();
    CHECK(apart(s) < 1e-6);
  }
  CHECK(bear > 10);
  CHECK(slip > 10);
}

TEST_CASE("sweeps stay near the rows that bear, and leave forces that they would change much") {
  test::Random random(507);
  constexpr int kUnknowns = 40;
  DenseMatrix chain = DenseMatrix::Zero(kUnknowns, kUnknowns), B = DenseMatrix::Zero(2, kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) {
    chain(i, i) = 2;
    if (i > 0) chain(i, i - 1) = chain(i - 1, i) = -1;
  }
  B(0, 0) = B(1, 20) = 1;
  Vector f = Vector::Zero(kUnknowns), c = Vector::Zero(2);
  f[0] = 1, c[1] = 100;
  const auto p = test::program(chain, f, B, c);
  Monitor quiet;
  const solver::HeldStiffness stiffness(p, problem::rigid_motions(p), solver::factor(algebra::Ordering::automatic), quiet);
  problem::State from{1e-3 * random.vector(kUnknowns), Vector::Zero(2)};
  const auto same = solver::relaxed(p, stiffness, from);  // nothing bears
  REQUIRE(same);
  CHECK(same->u.here() == from.u.here());
  from.lambda[0] = 1;
  const auto near = solver::relaxed(p, stiffness, from);
  REQUIRE(near);
  CHECK(near->u.here().head(5) != from.u.here().head(5));
  CHECK(near->u.here().tail(kUnknowns - 5) == from.u.here().tail(kUnknowns - 5));
  CHECK(near->lambda[1] == 0);
  from.lambda[0] = 10;
  CHECK_FALSE(solver::relaxed(p, stiffness, from));
}
