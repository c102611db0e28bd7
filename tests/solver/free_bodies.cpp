#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "base/error.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// A free grid of nodes with one unknown each, over an obstacle at `c` below some of them.
problem::Problem free_grid(test::Random& random, const Vector& f, int rows, const Vector& c) {
  problem::Problem p;
  problem::add(p, test::block("lid", test::spring_grid(random, 4, 4, 1, 0), f, 1, true));
  DenseMatrix B = DenseMatrix::Zero(rows, 16);
  for (int r = 0; r < rows; ++r) B(r, (5 * r) % 16) = 1;
  p.B = test::rows(B);
  p.c = c;
  p.groups = {test::group(problem::unilateral(), 0, rows)};
  return p;
}

}  // namespace

TEST_CASE("a free body pressed against rows has the solution that enumeration finds") {
  test::Random random(121);
  Monitor quiet;
  for (int trial = 0; trial < 80; ++trial) {
    Vector f = random.vector(16);
    f.array() += (0.5 + random.between(0, 1) - f.sum()) / 16;
    const auto p = free_grid(random, f, 5, random.vector(5) * (trial % 2 ? 1.0 : 0.0));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK((r.state.u.here() - exact->u.here()).norm() < 1e-9 * (1 + exact->u.here().norm()));
      CHECK((r.state.lambda - exact->lambda).norm() < 1e-9 * exact->lambda.norm());
    }
  }
}

TEST_CASE("load that lifts a free body off is refused, naming the motion and its work") {
  test::Random random(122);
  Monitor quiet;
  const auto p = free_grid(random, Vector::Constant(16, -0.25), 5, Vector::Zero(5));
  for (const bool reduced : {true, false})
    CHECK_THROWS_WITH_AS(solver::solve(p, test::pdas(reduced), quiet),
                         doctest::Contains("not held: nothing stops 'lid': translation along -x; the load does work 4"),
                         InputError);
}

TEST_CASE("a free body that no load drives is solved up to its motion, which is named") {
  test::Random random(123);
  Monitor quiet;
  Vector f = Vector::Zero(16);
  f[0] = 1, f[15] = -1;
  const auto p = free_grid(random, f, 5, Vector::Ones(5));
  for (const bool reduced : {true, false}) {
    const auto r = solver::solve(p, test::pdas(reduced), quiet);
    CHECK(r.converged);
    CHECK(r.reason.find("unique up to 'lid': translation along -x") != std::string::npos);
    CHECK(r.reason.find("limit case") == std::string::npos);  // no load that could turn
    CHECK(r.state.lambda.norm() < 1e-12);
    CHECK((p.B * r.state.u.here() - p.c).maxCoeff() < 1e-12);
    CHECK(problem::residual(p, r.state).equilibrium < 1e-12);
  }
}

TEST_CASE("a motion that no row notices is left out: the least displacement, in both forms") {
  test::Random random(125);
  Monitor quiet;
  problem::Problem p;  // two unknowns a node; the rows act on the second only
  Vector f = random.vector(18);
  for (int i = 0; i < 2; ++i) {
    double sum = 0;
    for (int k = i; k < 18; k += 2) sum += f[k];
    for (int k = i; k < 18; k += 2) f[k] += (i - sum) / 9;  // balanced along x, 1 along y
  }
  problem::add(p, test::block("lid", test::spring_grid(random, 3, 3, 2, 0), f, 2, true));
  DenseMatrix B = DenseMatrix::Zero(3, 18);
  B(0, 1) = B(1, 7) = B(2, 13) = 1;
  p.B = test::rows(B);
  p.c = Vector::Zero(3);
  p.groups = {test::group(problem::unilateral(), 0, 3)};
  const auto a = solver::solve(p, test::pdas(true), quiet), b = solver::solve(p, test::pdas(false), quiet);
  REQUIRE(a.converged);
  REQUIRE(b.converged);
  CHECK(a.reason.find("unique up to 'lid': translation along x, which no support or contact notices") != std::string::npos);
  CHECK((a.state.u.here() - b.state.u.here()).norm() < 1e-10 * a.state.u.here().norm());
  double along = 0;
  for (int k = 0; k < 18; k += 2) along += a.state.u.here()[k];
  CHECK(std::abs(along) < 1e-10 * a.state.u.here().norm());
  CHECK(problem::residual(p, a.state).equilibrium < 1e-11);
}

TEST_CASE("a free body that no row touches is refused, naming it") {
  test::Random random(124);
  Monitor quiet;
  auto p = free_grid(random, Vector::Ones(16), 5, Vector::Zero(5));
  problem::add(p, test::block("spare", test::spring_grid(random, 3, 3, 2, 0), Vector::Ones(18), 2, true));
  DenseMatrix B = DenseMatrix::Zero(5, 34);
  B.leftCols(16) = DenseMatrix(p.B);
  p.B = test::rows(B);
  CHECK_THROWS_WITH_AS(solver::solve(p, test::pdas(true), quiet), doctest::Contains("'spare' is not held: nothing stops its translation along x"),
                       InputError);
}

TEST_CASE("free bodies in a stack press through to the ground") {
  // Three single springs, free, on top of each other: each row carries the load above it.
  Monitor quiet;
  problem::Problem p;
  const DenseMatrix K{{1, -1}, {-1, 1}};
  for (int k = 0; k < 3; ++k) {
    test::SpringGrid bar{test::lower(K), {0, 1}, 2};
    Vector f = Vector::Zero(2);
    f[1] = 1;  // towards the ground, at the far end
    problem::add(p, test::block("bar " + std::to_string(k), bar, f, 1, true));
  }
  DenseMatrix B = DenseMatrix::Zero(3, 6);
  B(0, 0) = 1;                // bar 0 on the ground
  B(1, 2) = 1, B(1, 1) = -1;  // bar 1 on bar 0
  B(2, 4) = 1, B(2, 3) = -1;
  p.B = test::rows(B);
  p.c = Vector{{0.1, 0.2, 0.3}};
  p.groups = {test::group(problem::unilateral(), 0, 3)};
  for (const bool reduced : {true, false}) {
    const auto r = solver::solve(p, test::pdas(reduced), quiet);
    REQUIRE(r.converged);
    CHECK((r.state.lambda - Vector{{3, 2, 1}}).norm() < 1e-12);
    CHECK((r.state.u.here() - Vector{{0.1, 3.1, 3.3, 5.3, 5.6, 6.6}}).norm() < 1e-12);
  }
}
