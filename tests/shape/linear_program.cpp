// Right by optimality: A d ≤ b, bounds, y ≥ 0, z = g + Aᵀ y with the signs of active bounds, complementary; and by closed forms.
#include "shape/optimise/linear_program.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using shape::LinearProgram;
using shape::LinearStatus;
using shape::minimise;

namespace {

const double inf = INFINITY;

void check_optimal(const LinearProgram& p) {
  const auto s = minimise(p);
  REQUIRE(s.status == LinearStatus::solved);
  CHECK(s.reason.empty());
  const double tol = 1e-8;  // data of size 1, GLPK's tolerances are 1e-9
  const Vector slack = p.b - p.A * s.d;
  CHECK(slack.minCoeff() > -tol);
  CHECK(s.y.minCoeff() >= 0);
  CHECK(std::abs(slack.cwiseProduct(s.y).sum()) < tol * p.b.size());
  CHECK((s.z - p.g - p.A.transpose() * s.y).norm() < tol);
  double dual = -p.b.dot(s.y);  // + Σ lower z⁺ − upper z⁻
  for (Eigen::Index i = 0; i < p.g.size(); ++i) {
    CHECK(s.d[i] >= p.lower[i]);
    CHECK(s.d[i] <= p.upper[i]);
    if (s.d[i] > p.lower[i] + tol) CHECK(s.z[i] < tol);
    if (s.d[i] < p.upper[i] - tol) CHECK(s.z[i] > -tol);
    dual += std::max(s.z[i], 0.0) * p.lower[i] + std::min(s.z[i], 0.0) * p.upper[i];
  }
  CHECK(s.value == doctest::Approx(p.g.dot(s.d)));
  CHECK(std::abs(s.value - dual) < tol * (1 + std::abs(s.value)) * p.b.size());
}

}  // namespace

TEST_CASE("random linear programs are solved with their multipliers; no gap between primal and dual") {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 9, m = 1 + trial % 7;
    LinearProgram p;
    p.g = Vector::NullaryExpr(n, [&] { return number(engine); });
    p.A = DenseMatrix::NullaryExpr(m, n, [&] { return number(engine); });
    p.b = Vector::NullaryExpr(m, [&] { return std::abs(number(engine)); });  // d = 0 is feasible
    p.lower = Vector::Constant(n, -1);
    p.upper = Vector::Constant(n, 1);
    check_optimal(p);
  }
}

TEST_CASE("a box alone: each unknown at the end its price asks for") {
  LinearProgram p{Vector::Zero(3), DenseMatrix(0, 3), Vector(0), Vector::Constant(3, -2), Vector::Constant(3, 5)};
  p.g << 1, -3, 0.5;
  const auto s = minimise(p);
  REQUIRE(s.status == LinearStatus::solved);
  CHECK(s.d == Eigen::Vector3d(-2, 5, -2));
  CHECK(s.z == p.g);
  CHECK(s.y.size() == 0);
}

TEST_CASE("min −x − 2y under x + y ≤ 4, x + 3y ≤ 6, both ≥ 0: (3, 1), prices ½ and ½") {
  LinearProgram p{Eigen::Vector2d(-1, -2), DenseMatrix(2, 2), Eigen::Vector2d(4, 6), Vector::Zero(2), Vector::Constant(2, inf)};
  p.A << 1, 1, 1, 3;
  const auto s = minimise(p);
  REQUIRE(s.status == LinearStatus::solved);
  CHECK(s.d[0] == doctest::Approx(3));
  CHECK(s.d[1] == doctest::Approx(1));
  CHECK(s.y[0] == doctest::Approx(0.5));
  CHECK(s.y[1] == doctest::Approx(0.5));
  CHECK(s.value == doctest::Approx(-5));
}

TEST_CASE("contradictory rows, an endless fall and no unknowns are told apart") {
  LinearProgram p{Vector::Ones(1), DenseMatrix(2, 1), Eigen::Vector2d(-1, -1), Vector::Constant(1, -inf), Vector::Constant(1, inf)};
  p.A << 1, -1;  // d ≤ −1 and d ≥ 1
  CHECK(minimise(p).status == LinearStatus::infeasible);
  CHECK(minimise(p).d.size() == 0);
  p.b << inf, inf;
  CHECK(minimise(p).status == LinearStatus::unbounded);
  p.b << inf, 3;  // −d ≤ 3
  CHECK(minimise(p).d[0] == doctest::Approx(-3));
  const LinearProgram nothing{Vector(0), DenseMatrix(0, 0), Vector(0), Vector(0), Vector(0)};
  CHECK(minimise(nothing).status == LinearStatus::solved);
  CHECK(minimise(nothing).value == 0);
}

TEST_CASE("an unknown held by equal bounds, a degenerate vertex and scales 1e8 apart are no trouble") {
  LinearProgram p{Eigen::Vector3d(-1, -1, -1), DenseMatrix(4, 3), Vector(4), Vector::Zero(3), Vector::Ones(3)};
  p.A << 1, 1, 0, 2, 2, 0, 1, 0, 1, 1e8, 1e8, 1e8;
  p.b << 1, 2, 1, 1e8;
  p.lower[2] = p.upper[2] = 0.25;
  const auto s = minimise(p);
  REQUIRE(s.status == LinearStatus::solved);
  CHECK(s.d[2] == 0.25);
  CHECK(s.value == doctest::Approx(-1));
}

TEST_CASE("linear programs that are none are refused") {
  LinearProgram p{Vector::Ones(2), DenseMatrix::Zero(1, 2), Vector::Zero(1), Vector::Zero(2), Vector::Ones(2)};
  auto bad = p;
  bad.A.resize(1, 3);
  CHECK_THROWS_AS(minimise(bad), InputError);
  bad = p, bad.g[0] = NAN;
  CHECK_THROWS_AS(minimise(bad), InputError);
  bad = p, bad.b[0] = NAN;
  CHECK_THROWS_AS(minimise(bad), InputError);
  bad = p, bad.lower[1] = 2;
  CHECK_THROWS_WITH_AS(minimise(bad), "unknown 2 of a linear program is bounded by 2 and 1", InputError);
}
