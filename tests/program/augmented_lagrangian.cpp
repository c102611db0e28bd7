#include <doctest/doctest.h>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "programs.hpp"

using namespace dotyk;
using program::AugmentedLagrangian;
using program::Status;
using test::DenseMatrix;
using test::Random;
using test::Vector;

TEST_CASE("both updates reach the Kuhn-Tucker pair, whatever penalty and precision") {
  Random random(341);
  Monitor quiet;
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 8 + trial % 20, m = 1 + trial % 6;
    const DenseMatrix B = random.positive_definite(n, 0.5), D = random.matrix(m, n);
    const Vector c = random.vector(n), d = random.vector(m);
    DenseMatrix K = DenseMatrix::Zero(n + m, n + m);
    K << B, D.transpose(), D, DenseMatrix::Zero(m, m);
    Vector b(n + m);
    b << c, d;
    const Vector exact = algebra::PivotedLu(K).solve(b);
    const auto p = test::quadratic(B, -c, D, d, d);
    for (const auto update : {AugmentedLagrangian::Update::multiplier, AugmentedLagrangian::Update::least_squares})
      for (const double rho : {1.0, 1e3, 1e6})
        for (const double M : {0.1, 10.0}) {
          AugmentedLagrangian s;
          s.update = update, s.rho = rho, s.M = M;
          const auto r = program::solve(p, s, quiet);
          INFO(trial << ", rho " << rho << ", M " << M << ": " << r.reason);
          REQUIRE(r.status == Status::solved);
          CHECK((r.x - exact.head(n)).norm() < 1e-6 * (1 + exact.norm()));
          CHECK((r.y - exact.tail(m)).norm() < 1e-5 * (1 + exact.norm()));
          CHECK(r.iterations <= 60);
        }
  }
}

TEST_CASE("large penalties take few outer iterations, with either update the same") {
  Random random(342);
  Monitor quiet;
  const auto p = test::quadratic(random.positive_definite(20, 1), random.vector(20), random.matrix(4, 20), Vector::Ones(4), Vector::Ones(4));
  int outer[2][2];
  for (const int update : {0, 1})
    for (const int large : {0, 1}) {
      AugmentedLagrangian s;
      s.update = static_cast<AugmentedLagrangian::Update>(update);
      s.rho = large ? 1e6 : 1;
      s.gradient_tol = 1e-5, s.feasibility_tol = 1e-8;
      outer[update][large] = program::solve(p, s, quiet).iterations;
    }
  CHECK(outer[0][1] <= 3);
  CHECK(outer[0][1] == outer[1][1]);
  CHECK(outer[0][0] > outer[0][1]);
}

TEST_CASE("what augmented Lagrangians cannot take is refused or told") {
  Monitor quiet;
  const auto inequality = test::quadratic(DenseMatrix::Identity(2, 2), Vector::Ones(2), DenseMatrix::Identity(2, 2), Vector::Zero(2), Vector{{0, 1}});
  CHECK_THROWS_AS(program::solve(inequality, AugmentedLagrangian{}, quiet), InputError);
  DenseMatrix D(2, 2);
  D << 1, 1, 1, 1;
  const auto dependent = test::quadratic(DenseMatrix::Identity(2, 2), Vector::Ones(2), D, Vector::Zero(2), Vector::Zero(2));
  AugmentedLagrangian least;
  least.update = AugmentedLagrangian::Update::least_squares;
  CHECK_THROWS_AS(program::solve(dependent, least, quiet), InputError);
  CHECK(program::solve(dependent, AugmentedLagrangian{}, quiet).status == Status::solved);
  const auto flat = test::quadratic(DenseMatrix::Zero(2, 2), Vector{{1, 1}}, DenseMatrix{{1, -1}}, Vector::Zero(1), Vector::Zero(1));
  CHECK(program::solve(flat, AugmentedLagrangian{}, quiet).status == Status::unbounded);
}

TEST_CASE("the size of the objective does not matter; data out of range are refused") {
  Monitor quiet;
  const DenseMatrix I = DenseMatrix::Identity(2, 2), D = DenseMatrix::Ones(1, 2);
  const auto of_size = [&](double e) { return test::quadratic(2 * e * I, -e * Vector{{2, 5}}, D, Vector::Ones(1), Vector::Ones(1)); };
  for (const auto update : {AugmentedLagrangian::Update::multiplier, AugmentedLagrangian::Update::least_squares}) {
    AugmentedLagrangian s;
    s.update = update;
    for (const double e : {1e-99, 1e-18, 1.0, 1e18, 1e99}) {
      INFO(e);
      const auto r = program::solve(of_size(e), s, quiet);
      REQUIRE(r.status == Status::solved);
      CHECK(r.x[0] == doctest::Approx(-0.25));
      CHECK(r.x[1] == doctest::Approx(1.25));
      CHECK(r.y[0] / e == doctest::Approx(2.5));
    }
    for (const double e : {1e-300, 1e-150, 1e150, 1e300})
      CHECK_THROWS_WITH_AS(program::solve(of_size(e), s, quiet), doctest::Contains("beyond the range of numbers: the greatest entry of B is"), InputError);
  }
}
