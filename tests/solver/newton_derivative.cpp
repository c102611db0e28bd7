#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/friction_rows.hpp"
#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "solver/rows/newton.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

struct Case {
  problem::Problem problem;
  problem::CondensedProblem condensed;
  solver::NaturalMap map;
  DenseMatrix W;  ///< scaled
  double least, greatest;

  Case(problem::Problem p, const DenseMatrix& compliance, const Vector& x0, const Vector& rho)
      : problem(std::move(p)), condensed(compliance, x0), map(problem, condensed, rho) {
    Vector root(rho.size());
    for (int r = 0; r < rho.size(); ++r) root[r] = map.lambda(Vector::Unit(rho.size(), r))[r];
    W = root.asDiagonal() * compliance * root.asDiagonal();
    const Vector eigenvalues = algebra::eigenvalues(W);
    least = eigenvalues.minCoeff();
    greatest = eigenvalues.maxCoeff();
  }
};

Case random_case(test::Random& random, int points, int components, bool coulomb, double friction) {
  const int m = points * (1 + components);
  Vector rho(m);
  for (double& r : rho) r = std::pow(10, random.between(-1, 1));
  return {test::friction_rows(points, components, coulomb, friction), random.positive_definite(m, 0.1),
          2 * random.vector(m), rho};
}

/// The scaled derivative on all rows.
DenseMatrix derivative(const Case& c, const solver::NaturalMap::Value& v) {
  const int m = c.condensed.rows();
  DenseMatrix S = DenseMatrix::Zero(m, m);
  for (const auto& t : v.slope) S(t.row(), t.col()) += t.value();
  return DenseMatrix::Identity(m, m) - S * (DenseMatrix::Identity(m, m) - c.W);
}

}  // namespace

TEST_CASE("the Newton system is the derivative of the natural map: finite differences") {
  test::Random random(401);
  for (int trial = 0; trial < 200; ++trial) {
    const Case c = random_case(random, 4, 1 + trial % 2, random.coin(), 0.7);
    const int m = c.condensed.rows();
    const Vector lambda = 2 * random.vector(m);
    const auto v = c.map.at(lambda, Vector());
    const DenseMatrix J = derivative(c, v);
    const auto F = [&](const Vector& at) { return Vector(at - c.map.at(at, Vector()).projected); };
    const double h = 1e-6;
    for (int r = 0; r < m; ++r) {
      const Vector step = c.map.lambda(Vector::Unit(m, r));
      if (c.map.at(lambda + h * step, Vector()).differences(v) + c.map.at(lambda - h * step, Vector()).differences(v) > 0)
        continue;  // a kink in between
      const Vector slope = c.map.scaled_lambda(F(lambda + h * step) - F(lambda - h * step)) / (2 * h);
      CHECK((slope - J.col(r)).norm() < 1e-7 * (1 + J.norm()));
    }
    // The system keeps the rows with a slope; the others are rows of the identity.
    const auto system = c.map.linearise(v);
    for (std::size_t i = 0; i < system.rows.size(); ++i)
      for (std::size_t j = 0; j < system.rows.size(); ++j)
        CHECK(std::abs(system.matrix(i, j) - J(system.rows[i], system.rows[j])) < 1e-13 * (1 + J.norm()));
    CHECK(J.determinant() == doctest::Approx(system.matrix.size() ? system.matrix.determinant() : 1).epsilon(1e-9));
  }
}

TEST_CASE("with given friction the derivative is regular on all pieces, by no less than the bound says") {
  test::Random random(402);
  double nearest = 1e300;
  for (int trial = 0; trial < 1000; ++trial) {
    const Case c = random_case(random, 1 + random.below(4), 1 + trial % 2, false, 0.7);
    const auto v = c.map.at(2 * random.vector(c.condensed.rows()), Vector());
    const auto system = c.map.linearise(v);
    if (system.matrix.size() == 0) continue;
    const double bound = c.least / (c.least + std::max(c.greatest - 1, 1 - c.least));
    const double singular_value = algebra::smallest_singular_value(system.matrix);
    CHECK(singular_value >= bound * (1 - 1e-12));
    nearest = std::min(nearest, singular_value / bound);
  }
  CHECK(nearest < 2);  // the bound is not idle
}

TEST_CASE("with Coulomb friction the bound holds below mu = 2 sqrt(kappa)/(1 + kappa)") {
  test::Random random(403);
  for (int trial = 0; trial < 1000; ++trial) {
    const Case unit = random_case(random, 1 + random.below(4), 1 + trial % 2, true, 1);
    const double kappa = unit.greatest / unit.least, limit = 2 * std::sqrt(kappa) / (1 + kappa);
    const double mu = random.between(0, 0.95) * limit;
    const int m = unit.condensed.rows(), components = 1 + trial % 2;
    const Case c(test::friction_rows(m / (1 + components), components, true, mu), unit.W, 2 * random.vector(m),
                 Vector::Ones(m));
    const auto system = c.map.linearise(c.map.at(2 * random.vector(m), Vector()));
    if (system.matrix.size() == 0) continue;
    const double delta = std::max(c.greatest - 1, 1 - c.least);
    const double bound = 1 / (1 + (1 + mu) * delta / ((limit - mu) * c.least));
    CHECK(algebra::smallest_singular_value(system.matrix) >= bound * (1 - 1e-12));
  }
}

TEST_CASE("with Coulomb friction one point's derivative is singular at mu = W_nn/|W_nt|, and there alone") {
  const DenseMatrix W{{1, -0.5}, {-0.5, 1}};
  for (const double mu : {1.9, 2.0, 2.1}) {
    const Case c(test::friction_rows(1, 1, true, mu), W, Vector{{1, 9}}, Vector::Ones(2));
    const auto system = c.map.linearise(c.map.at(Vector{{1, 1}}, Vector()));  // closed, slips
    CHECK(system.matrix.determinant() == doctest::Approx(1 - 0.5 * mu));
    if (mu == 2) CHECK(algebra::smallest_singular_value(system.matrix) < 1e-15);
  }
}

TEST_CASE("the whole derivative of TR965 (2.27) is singular with the condensed one, and not much more nearly") {
  test::Random random(404);
  for (int trial = 0; trial < 200; ++trial) {
    const int points = 3, components = 1 + trial % 2, m = points * (1 + components), n = m + 3;
    const DenseMatrix K = random.positive_definite(n, 0.5), B = random.matrix(m, n), W = B * algebra::Ldlt(K).solve(DenseMatrix(B.transpose()));
    Vector rho(m);
    for (double& r : rho) r = std::pow(10, random.between(-1, 1));
    const Case c(test::friction_rows(points, components, false, 0.7), W, random.vector(m), rho);
    const auto v = c.map.at(2 * random.vector(m), Vector());
    const DenseMatrix J = derivative(c, v), I = DenseMatrix::Identity(m, m);
    DenseMatrix S = DenseMatrix::Zero(m, m), R = DenseMatrix::Zero(m, m), G(n + m, n + m);
    for (const auto& t : v.slope) S(t.row(), t.col()) += t.value();
    for (int r = 0; r < m; ++r) R(r, r) = c.map.lambda(Vector::Unit(m, r))[r];  // √ρ
    G << K, B.transpose(), -S * R * R * B, I - S;
    CHECK(G.determinant() == doctest::Approx(K.determinant() * J.determinant()).epsilon(1e-8));
    // In the norm of the energy and with scaled multipliers:
    DenseMatrix L = K, scaled = B.transpose();
    CHECK(algebra::cholesky(L));
    algebra::solve_lower(L, scaled);
    scaled = DenseMatrix(R * scaled.transpose());
    G << DenseMatrix::Identity(n, n), scaled.transpose(), -S * scaled, I - S;
    const double whole = algebra::smallest_singular_value(G), condensed = algebra::smallest_singular_value(J);
    CHECK(whole <= condensed * (1 + 1e-10));
    CHECK(whole >= condensed / (condensed + 1 + c.greatest) * (1 - 1e-10));
  }
}
