#include "algebra/dense/decompositions.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <limits>

#include "../support/random.hpp"
#include "algebra/direct/stop_factoring.hpp"

using namespace dotyk;
using namespace dotyk::algebra;

TEST_CASE("LU solves with the matrix and its transpose, within a panel and beyond") {
  test::Random random(4);
  for (int n : {1, 2, 5, 130, 512, 513, 1100}) {
    const DenseMatrix A = random.matrix(n, n), B = random.matrix(n, 3);
    const Vector b = random.vector(n);
    const Lu lu(A);
    REQUIRE(lu.regular());
    const double unsure = 1e-15 * n / lu.rcond();  // backward stable: n ε κ
    CHECK(test::relative(A * lu.solve(b), b) < unsure);
    CHECK(test::relative(A.transpose() * lu.solve_transposed(b), b) < unsure);
    CHECK(test::relative(A.transpose() * lu.solve_transposed(B), B) < unsure);
    // LAPACK's estimate is a lower bound of ‖A⁻¹‖₁, in practice within a factor of 3 (Higham 2002, section 15.3).
    const double exact = 1 / A.inverse().cwiseAbs().colwise().sum().maxCoeff();
    CHECK(lu.inverse_norm_reciprocal() >= 0.99 * exact);
    CHECK(lu.inverse_norm_reciprocal() <= 3 * exact);
  }
  CHECK(Lu(DenseMatrix(0, 0)).rcond() == 1);
  CHECK(Lu(DenseMatrix(0, 0)).solve(Vector(0)).size() == 0);
}

TEST_CASE("LU says of singular matrices and of those with NaN that they are not regular") {
  const Lu singular(DenseMatrix::Ones(3, 3));
  CHECK_FALSE(singular.regular());
  CHECK(singular.rcond() == 0);
  DenseMatrix unknown = DenseMatrix::Identity(600, 600);
  unknown(550, 540) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(Lu(unknown).rcond() > 0);
}

TEST_CASE("LU ends between panels once the monitor asks to stop") {
  struct Now : Monitor {
    bool stop() override { return true; }
  } monitor;
  const StopFactoring watched(monitor);
  CHECK_THROWS_AS(Lu(DenseMatrix::Identity(2000, 2000)), Interrupted);
}
