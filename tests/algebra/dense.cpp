#include "algebra/dense/dense.hpp"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "../support/random.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"

using namespace dotyk;
using namespace dotyk::algebra;

TEST_CASE("dense kernels agree with Eigen") {
  test::Random random(21);
  for (int n : {1, 2, 5, 40, 130}) {  // 130: beyond one BLAS block
    const DenseMatrix A = random.positive_definite(n, 1), b = random.matrix(n, 3);
    DenseMatrix L = A;
    REQUIRE(cholesky(L));
    CHECK(L.isLowerTriangular(0));
    CHECK(test::relative(L * L.transpose(), A) < 1e-13);
    DenseMatrix x = b;
    solve_lower(L, x);
    CHECK(test::relative(L * x, b) < 1e-12);
    solve_lower_transposed(L, x);
    CHECK(test::relative(A * x, b) < 1e-11);
    CHECK(test::relative(square(L), A) < 1e-13);
    CHECK(test::relative(gram(b), b.transpose() * b) < 1e-13);
    // A block of a larger matrix is worked on in place.
    DenseMatrix wide = random.matrix(n + 2, 4);
    const DenseMatrix before = wide;
    solve_lower(L, wide.block(1, 1, n, 2));
    CHECK(test::relative(L * wide.block(1, 1, n, 2), before.block(1, 1, n, 2)) < 1e-12);
    CHECK(wide.row(0) == before.row(0));
    CHECK(wide.row(n + 1) == before.row(n + 1));
  }
}

TEST_CASE("orthogonal factors, within a panel and beyond") {
  test::Random random(22);
  for (const auto& [m, n] : {std::pair(1, 1), {5, 3}, {64, 64}, {200, 65}, {300, 130}}) {
    const DenseMatrix X = random.matrix(m, n);
    const OrthogonalFactors f = orthogonal_factors(X);
    CHECK(f.R.isUpperTriangular(0));
    CHECK(test::relative(f.Q * f.R, X) < 1e-13);
    CHECK(test::relative(f.Q.transpose() * f.Q, DenseMatrix::Identity(n, n)) < 1e-13);
  }
}

namespace {

/// Asks to stop at the question of this number.
struct StopAt : Monitor {
  explicit StopAt(int question) : left(question) {}
  bool stop() override { return ++asked, --left < 0; }
  int left, asked = 0;
};

}  // namespace

TEST_CASE("large dense kernels, taken in pieces, are the same, and end where their watcher asks to stop") {
  const int n = 4200;  // n³/3 multiplications are three pieces
  DenseMatrix A = DenseMatrix::Constant(n, n, 0.5);
  for (int i = 0; i < n; ++i) A(i, i) = 2 + i % 7;
  Vector x = Vector::LinSpaced(n, -1, 1);
  const Vector b = A * x;
  StopAt never(1 << 30), soon(3);
  {
    const StopFactoring watched(never);
    DenseMatrix L = A;
    REQUIRE(cholesky(L));
    Vector y = b;
    solve_lower(L, y);
    solve_lower_transposed(L, y);
    CHECK((y - x).norm() <= 1e-12 * x.norm());
    CHECK(never.asked > 4);
    const DenseMatrix back = square(L), inverse = [&] {
      DenseMatrix all = DenseMatrix::Identity(n, n);
      solve_lower(L, all);
      return all;
    }();
    CHECK((back - A).norm() <= 1e-12 * A.norm());
    CHECK((L * (inverse * x) - x).norm() <= 1e-12 * x.norm());
    L = A;
    L(n - 1, n - 1) = -1;
    CHECK_FALSE(cholesky(L));
  }
  const StopFactoring watched(soon);
  CHECK_THROWS_AS(square(A), Interrupted);
  CHECK_THROWS_AS(cholesky(A), Interrupted);
  CHECK_THROWS_AS(orthogonal_factors(A), Interrupted);
}

TEST_CASE("dense Cholesky refuses what is not positive definite") {
  DenseMatrix indefinite(2, 2), zero = DenseMatrix::Zero(1, 1);
  indefinite << 1, 2, 2, 1;
  CHECK_FALSE(cholesky(indefinite));
  CHECK_FALSE(cholesky(zero));
}

TEST_CASE("dense kernels of nothing") {
  DenseMatrix none(0, 0), x(0, 3);
  CHECK(cholesky(none));
  solve_lower(none, x);
  CHECK(gram(DenseMatrix(0, 3)) == DenseMatrix::Zero(3, 3));
  CHECK(gram(DenseMatrix(3, 0)).size() == 0);
  CHECK(square(none).size() == 0);
  DenseMatrix wrong(2, 1);
  CHECK_THROWS_AS(solve_lower(none, wrong), std::logic_error);
}

TEST_CASE("the least singular value of a matrix made of known ones") {
  test::Random random(22);
  for (int n : {1, 2, 5, 40, 130})
    for (const double least : {1.0, 1e-5, 1e-13, 0.0}) {
      const DenseMatrix U = Eigen::HouseholderQR<DenseMatrix>(random.matrix(n, n)).householderQ(),
                        V = Eigen::HouseholderQR<DenseMatrix>(random.matrix(n, n)).householderQ();
      Vector s = Vector::LinSpaced(n, 1, 3);
      s[n / 2] = least;
      CHECK(std::abs(smallest_singular_value(U * s.asDiagonal() * V) - least) < 1e-14);
    }
  CHECK(smallest_singular_value(DenseMatrix(0, 0)) == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(smallest_singular_value(DenseMatrix::Constant(2, 2, std::nan("")))));
  CHECK_THROWS_AS(smallest_singular_value(DenseMatrix::Zero(2, 3)), std::logic_error);
}

TEST_CASE("singular values of U diag(s) Vᵀ are s, whatever the shape") {
  test::Random random(22);
  for (const auto& [m, n] : {std::pair{1, 1}, {7, 3}, {3, 7}, {40, 40}}) {
    const int count = std::min(m, n);
    const DenseMatrix U = orthonormal(random.matrix(m, count)), V = orthonormal(random.matrix(n, count));
    const Vector s = Vector::LinSpaced(count, 3, 1);
    CHECK((singular_values(U * s.asDiagonal() * V.transpose()) - s).lpNorm<Eigen::Infinity>() < 1e-13);
  }
  const DenseMatrix deficient = random.matrix(9, 4) * random.matrix(4, 6);
  const Vector s = singular_values(deficient);
  CHECK(s.size() == 6);
  CHECK((s.array() > 1e-12 * s[0]).count() == 4);
  CHECK(singular_values(DenseMatrix(0, 5)).size() == 0);
  CHECK(std::isnan(singular_values(DenseMatrix::Constant(2, 3, NAN))[1]));
}
