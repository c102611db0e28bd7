#include <doctest/doctest.h>

#include "algebra/dense/decompositions.hpp"
#include "programs.hpp"

using namespace dotyk;
using program::Status;
using test::DenseMatrix;
using test::Random;
using test::Vector;

TEST_CASE("a body held by contact alone: springs in a row above a floor, pushed down") {
  // Netuka's case: C is the stiffness of free springs, singular; contact holds them as long as the load pushes.
  Monitor quiet;
  const int n = 12;
  DenseMatrix C = DenseMatrix::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) C(i, i) += 1, C(i + 1, i + 1) += 1, C(i, i + 1) -= 1, C(i + 1, i) -= 1;
  for (const double push : {1.0, 1e-3, 0.0, -1.0}) {
    // Unequal loads with the sum −push; only every third unknown meets the floor.
    Vector load = Vector::LinSpaced(n, -1, 1);
    load.array() -= push / n;
    DenseMatrix A = DenseMatrix::Zero(4, n);
    for (int k = 0; k < 4; ++k) A(k, 3 * k) = 1;
    const auto p = test::quadratic(C, -load, A, Vector::Zero(4), Vector::Constant(4, INFINITY));
    for (const auto& settings : {test::one(), test::many()}) {
      const auto r = program::solve(p, settings, quiet);
      INFO(push << ": " << r.reason);
      if (push < 0) {
        CHECK(r.status == Status::unbounded);
        CHECK((r.direction / r.direction[0] - Vector::Ones(n)).norm() < 1e-6);  // it lifts off as a whole
        continue;
      }
      REQUIRE(r.status == Status::solved);
      CHECK(std::abs(r.y.sum() + push) < 1e-9);  // equilibrium of the whole
      CHECK(r.y.maxCoeff() < 1e-12);
      CHECK(r.singular > 0);
      CHECK(r.survived == r.singular);
    }
  }
}

TEST_CASE("linear programs are programs with P = 0") {
  Random random(321);
  Monitor quiet;
  for (int trial = 0; trial < 60; ++trial) {
    const auto p = test::boxed(random, 3 + trial % 20, trial % 15, 0);
    const auto r = program::solve(p, test::one(), quiet), other = program::solve(p, program::InteriorPoint{}, quiet);
    REQUIRE(r.status == Status::solved);
    CHECK(std::abs(r.objective - other.objective) <= 1e-6 * (1 + std::abs(r.objective)));
    CHECK(test::worst(r.residual) < 1e-9);
  }
}

TEST_CASE("programs whose only solution is 0, where only rounding is left of x to measure violations by") {
  // q = −Aᵀy with y > 0 and A of full rank: qᵀx = −yᵀAx > 0 for x ≠ 0 in the cone Ax ≤ 0.
  Random random(323);
  Monitor quiet;
  const auto check = [&](const program::QuadraticProgram& p) {
    const auto other = program::solve(p, program::InteriorPoint{}, quiet);
    for (const auto& settings : {test::one(), test::many()}) {
      const auto r = program::solve(p, settings, quiet);
      INFO(r.reason << "; interior point: " << other.reason);
      REQUIRE(r.status == Status::solved);
      CHECK(r.x.norm() <= 1e-12);
      CHECK(test::worst(r.residual) < 1e-9);
      CHECK(std::abs(r.objective - other.objective) <= 1e-6);
    }
  };
  check(test::quadratic(DenseMatrix::Zero(2, 2), Vector{{4, -4}}, DenseMatrix{{-1, 1}, {0, -1}}, Vector::Constant(2, -INFINITY), Vector::Zero(2)));
  for (int trial = 0; trial < 400; ++trial) {
    const int n = 1 + trial % 5, rows = n + random.below(4), far = random.below(2);
    DenseMatrix A = random.matrix(rows + far, n);
    if (trial % 2) A = (3 * A).array().round();
    if (algebra::PivotedLu(A.topRows(rows)).rank() < n) continue;
    Vector y = Vector::Zero(rows + far), high = Vector::Zero(rows + far);
    for (int r = 0; r < rows; ++r) y[r] = random.between(0.1, 4);
    high.tail(far).setOnes();  // rows that do not matter
    const DenseMatrix P = test::semidefinite(random, n, random.below(n));
    check(test::quadratic(P, -A.transpose() * y, A, Vector::Constant(rows + far, -INFINITY), high));
    // The same beside an unknown in no row.
    DenseMatrix wider = DenseMatrix::Identity(n + 1, n + 1);
    wider.topLeftCorner(n, n) = P;
    Vector q(n + 1);
    q << -A.transpose() * y, -4;
    const auto r = program::solve(test::quadratic(wider, q, DenseMatrix(A * DenseMatrix::Identity(n, n + 1)), Vector::Constant(rows + far, -INFINITY), high), test::one(), quiet);
    REQUIRE(r.status == Status::solved);
    CHECK(r.x.head(n).norm() <= 1e-9);
    CHECK(std::abs(r.x[n] - 4) <= 1e-8);
  }
}

TEST_CASE("zigzagging is noticed and ends: Beale's program, on which Dantzig's rule cycles") {
  Monitor quiet;
  // min −¾x₁ + 150x₂ − x₃/50 + 6x₄, rows ≤ 0, 0, 1, x ≥ 0; optimum −1/20 (Beale 1955).
  DenseMatrix A(7, 4);
  A << 0.25, -60, -0.04, 9, 0.5, -90, -0.02, 3, 0, 0, 1, 0, DenseMatrix::Identity(4, 4);
  Vector low = Vector::Constant(7, -INFINITY), high = Vector::Constant(7, INFINITY);
  high.head(3) << 0, 0, 1;
  low.tail(4).setZero();
  const auto p = test::quadratic(DenseMatrix::Zero(4, 4), Vector{{-0.75, 150, -0.02, 6}}, A, low, high);
  for (const auto& settings : {test::one(), test::many()}) {
    const auto r = program::solve(p, settings, quiet);
    REQUIRE(r.status == Status::solved);
    CHECK(r.objective == doctest::Approx(-0.05));
    CHECK(r.iterations < 40);
  }
}

TEST_CASE("zigzagging is noticed and ends: a matrix on which whole active sets go round in circles") {
  Monitor quiet;
  DenseMatrix P(3, 3);
  P << 4, 5, -5, 5, 9, -5, -5, -5, 7;  // Curtis, Han and Robinson 2015
  const auto p = test::quadratic(P, Vector{{2, 1, -3}}, DenseMatrix::Identity(3, 3), Vector::Zero(3), Vector::Constant(3, INFINITY));
  auto settings = test::many();
  settings.start = program::ActiveSet::Start::cold;
  settings.working = {program::Side::low, program::Side::low, program::Side::low};
  const auto r = program::solve(p, settings, quiet);
  REQUIRE(r.status == Status::solved);
  CHECK(r.repeats > 0);
  CHECK(test::worst(r.residual) < 1e-12);
}

TEST_CASE("a monitor may stop a solve; the best point is handed back") {
  struct Impatient : Monitor {
    int asked = 0;
    bool stop() override { return ++asked > 3; }
  } impatient;
  Random random(322);
  const auto p = test::boxed(random, 40, 20, 40);
  auto settings = test::one();
  settings.start = program::ActiveSet::Start::cold;
  const auto r = program::solve(p, settings, impatient);
  CHECK(r.status == Status::stopped);
  CHECK(r.reason == "stopped on request");
  CHECK(r.x.size() == 40);
}
