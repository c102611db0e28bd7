#include <doctest/doctest.h>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "program/certificate.hpp"
#include "programs.hpp"

using namespace dotyk;
using program::Status;
using test::DenseMatrix;
using test::Random;
using test::Vector;

namespace {

enum class Kind { feasible, contradictory, unbounded };

/// m rows ≥ low through a known point; contradictory ones by a positive combination of rows that is 0 ≥ 0.01,
/// unbounded ones by a direction in the kernel of P along which every row opens and the objective falls.
program::QuadraticProgram make(Random& random, Kind kind, int n, int m, int rank) {
  const DenseMatrix P = test::semidefinite(random, n, rank);
  DenseMatrix A = random.matrix(m, n);
  Vector q = random.vector(n);
  if (kind == Kind::unbounded) {
    const Vector d = rank ? Vector(algebra::PivotedLu(P).kernel().col(0)) : Vector(Vector::Unit(n, 0));
    if (q.dot(d) > 0) q = -q;
    for (int r = 0; r < m; ++r)
      if (A.row(r).dot(d) < 0) A.row(r) *= -1;
  }
  Vector low = A * random.vector(n) - random.vector(m).cwiseAbs();
  if (kind == Kind::contradictory) {
    const Vector weight = random.vector(m - 1).cwiseAbs();
    A.row(m - 1) = -weight.transpose() * A.topRows(m - 1);
    low[m - 1] = -weight.dot(low.head(m - 1)) + 0.01;
  }
  return test::quadratic(P, q, A, low, Vector::Constant(m, INFINITY));
}

}  // namespace

TEST_CASE("contradictory rows are found and proved, whatever the objective does") {
  Random random(311);
  Monitor quiet;
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 2 + trial % 7;
    const auto p = make(random, Kind::contradictory, n, 3 + trial % 5, trial % (n + 1));
    for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet),
                          program::solve(p, program::InteriorPoint{}, quiet)}) {
      INFO(trial << ": " << r.reason);
      REQUIRE(r.status == Status::infeasible);
      CHECK(program::proves_infeasible(p, r.direction, 1e6));
    }
  }
}

TEST_CASE("unbounded programs are found, with the direction") {
  Random random(312);
  Monitor quiet;
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 2 + trial % 7;
    const auto p = make(random, Kind::unbounded, n, 3 + trial % 5, trial % n);
    for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet),
                          program::solve(p, program::InteriorPoint{}, quiet)}) {
      INFO(trial << ": " << r.reason);
      REQUIRE(r.status == Status::unbounded);
      CHECK(program::proves_unbounded(p, r.direction, 1e-6));
    }
  }
}

TEST_CASE("programs without a point are infeasible after few iterations, although their objective falls for ever along a direction that meets no row") {
  Random random(315);
  Monitor quiet;
  const auto check = [&](const DenseMatrix& P, const Vector& q, const DenseMatrix& A, const program::QuadraticProgram& limits) {
    const auto p = test::quadratic(P, q, A, limits.low, limits.high);
    for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet),
                          program::solve(p, program::InteriorPoint{}, quiet)}) {
      INFO(r.reason);
      REQUIRE(r.status == Status::infeasible);
      CHECK(program::proves_infeasible(p, r.direction, 1e6));
      CHECK(r.iterations < 60 + 10 * p.rows());
    }
  };
  for (int trial = 0; trial < 120; ++trial) {
    // Beside an unknown that nothing holds; then in other coordinates.
    const int n = trial % 10 == 9 ? 20 : 1 + trial % 8, m = n == 20 ? 60 : 3 + trial % 5;
    const auto p = n == 1 ? test::quadratic(DenseMatrix::Constant(1, 1, trial % 3), Vector::Zero(1), DenseMatrix::Ones(2, 1), Vector{{1, -INFINITY}}, Vector{{INFINITY, 0}})
                          : make(random, Kind::contradictory, n, m, trial % (n + 1));
    DenseMatrix P = DenseMatrix::Zero(n + 1, n + 1), A = DenseMatrix::Zero(p.rows(), n + 1);
    P.topLeftCorner(n, n) = test::full(p.P), A.leftCols(n) = p.A;
    Vector q(n + 1);
    q << p.q, random.coin() ? -1 : 1;
    const DenseMatrix turned = random.matrix(n + 1, n + 1);
    INFO(trial);
    check(P, q, A, p);
    check(turned.transpose() * P * turned, turned.transpose() * q, A * turned, p);
  }
}

TEST_CASE("the methods agree on programs of unknown kind") {
  Random random(313);
  Monitor quiet;
  int solved = 0, unbounded = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 2 + trial % 7;
    const auto p = make(random, Kind::feasible, n, 3 + trial % 5, trial % (n + 1));
    const auto one = program::solve(p, test::one(), quiet), many = program::solve(p, test::many(), quiet);
    const auto interior = program::solve(p, program::InteriorPoint{}, quiet);
    INFO(trial << ": " << one.reason << ", " << many.reason << ", " << interior.reason);
    CHECK(one.status == many.status);
    CHECK(one.status == interior.status);
    solved += one.status == Status::solved, unbounded += one.status == Status::unbounded;
    if (one.status == Status::solved) {
      CHECK(test::worst(one.residual) < 1e-8);
      CHECK(std::abs(one.objective - many.objective) <= 1e-8 * (1 + std::abs(one.objective)));
      CHECK(std::abs(one.objective - interior.objective) <= 1e-6 * (1 + std::abs(one.objective)));
    }
  }
  CHECK(solved > 20);
  CHECK(unbounded > 20);
}

TEST_CASE("the rows that contradict one another are named") {
  Monitor quiet;
  DenseMatrix A(3, 2);
  A << 1, 1, 1, 0, 1, 1;
  const auto p = test::quadratic(DenseMatrix::Zero(2, 2), Vector::Ones(2), A, Vector{{1, 0, -INFINITY}}, Vector{{INFINITY, INFINITY, 0}});
  const auto r = program::solve(p, test::one(), quiet);
  CHECK(r.status == Status::infeasible);
  CHECK(r.reason == "the rows contradict one another: rows 1, 3");
}

TEST_CASE("a matrix that is not positive semidefinite is refused, with a direction that shows it") {
  Random random(314);
  Monitor quiet;
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 2 + trial % 8;
    DenseMatrix P = test::semidefinite(random, n, n - 1);
    const Vector v = random.vector(n).normalized();
    P -= (1e-4 + v.dot(P * v)) * v * v.transpose();
    const auto p = test::quadratic(P, random.vector(n), DenseMatrix::Identity(n, n), -Vector::Ones(n), Vector::Ones(n));
    const auto r = program::solve(p, test::one(), quiet);
    REQUIRE(r.status == Status::not_convex);
    CHECK(r.direction.dot(P * r.direction) < 0);
    CHECK(program::solve(p, program::InteriorPoint{}, quiet).status == Status::not_convex);
  }
}

TEST_CASE("input that does not fit is refused, naming the row") {
  auto p = test::quadratic(DenseMatrix::Identity(2, 2), Vector::Ones(2), DenseMatrix::Identity(2, 2), Vector{{0, 3}}, Vector{{1, 2}});
  CHECK_THROWS_WITH_AS(program::check(p), "row 2 has low = 3 above high = 2", InputError);
  p.low[1] = NAN;
  CHECK_THROWS_WITH_AS(program::check(p), "row 2 has nan as a limit", InputError);
  p.q = Vector::Ones(3);
  CHECK_THROWS_AS(program::check(p), InputError);
}

TEST_CASE("programs without a minimum whose P has empty rows are unbounded, not solved far away") {
  Monitor quiet;
  for (const double slope : {1.0, 1e-3, 1e3})
    for (const double stiff : {1.0, 2.0, 1e-4})
      for (const bool bounded : {false, true}) {
        DenseMatrix P = DenseMatrix::Zero(3, 3);
        P(0, 0) = stiff;
        Vector q(3);
        q << -1, -slope, 0;
        const DenseMatrix A = bounded ? DenseMatrix(DenseMatrix::Identity(3, 3)) : DenseMatrix(0, 3);
        const Vector low = Vector::Zero(A.rows());
        const auto p = test::quadratic(P, q, A, low, Vector::Constant(A.rows(), INFINITY));
        for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet),
                              program::solve(p, program::InteriorPoint{}, quiet)}) {
          INFO(slope << ' ' << stiff << ' ' << bounded << ": " << r.reason);
          REQUIRE(r.status == Status::unbounded);
          CHECK(program::proves_unbounded(p, r.direction, 1e-6));
        }
      }
}
