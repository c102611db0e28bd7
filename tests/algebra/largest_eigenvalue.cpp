#include "algebra/krylov/lanczos.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/stop_factoring.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {
double exact(const DenseMatrix& A) { return eigenvalues(A).maxCoeff(); }
}  // namespace

TEST_CASE("the greatest eigenvalue is bounded from above, closely, with and without scaling") {
  test::Random random(7);
  for (const int n : {1, 2, 3, 10, 60, 61, 150})
    for (const int rank : {1, n / 2, n}) {
      if (rank < 1) continue;
      const DenseMatrix G = random.matrix(n, rank), A = G * G.transpose();
      Vector s(n);
      for (double& v : s) v = std::pow(10, random.between(-2, 2));
      const DenseMatrix scaled = s.asDiagonal() * A * s.asDiagonal();
      for (const auto& [bound, value] : {std::pair(algebra::largest_eigenvalue(A), exact(A)),
                                         std::pair(algebra::largest_eigenvalue(A, s), exact(scaled))}) {
        CHECK(bound >= value);
        CHECK(bound <= 1.01 * value);
      }
    }
}

TEST_CASE("a proved bound holds where Lanczos does not see the greatest eigenvalue, and is as close as another elsewhere") {
  test::Random random(8);
  for (const int n : {1, 2, 10, 61, 150}) {
    const DenseMatrix G = random.matrix(n, n), A = G * G.transpose();
    CHECK(algebra::proved_largest_eigenvalue(A) >= exact(A));
    CHECK(algebra::proved_largest_eigenvalue(A) <= 1.01 * exact(A));
    if (n < 10) continue;
    // I, and a direction of eigenvalue 2 that the start has no part in.
    const Vector start = algebra::lanczos_start(n);
    Vector hidden = random.matrix(n, 1);
    hidden -= start * start.dot(hidden);
    hidden.normalize();
    const DenseMatrix B = DenseMatrix::Identity(n, n) + hidden * hidden.transpose();
    CHECK(algebra::largest_eigenvalue(B) < 1.99);
    CHECK(algebra::proved_largest_eigenvalue(B) >= 2 - 1e-12);
    CHECK(algebra::proved_largest_eigenvalue(B) <= 2.03);
  }
  CHECK(algebra::proved_largest_eigenvalue(DenseMatrix(0, 0)) == 0);
  CHECK(algebra::proved_largest_eigenvalue(DenseMatrix::Zero(4, 4)) == 0);
}

TEST_CASE("the proof ends when it is asked to stop") {
  struct Stopped final : Monitor {
    bool stop() override { return true; }
  } monitor;
  const algebra::StopFactoring stop(monitor);
  CHECK_THROWS_AS(algebra::proved_largest_eigenvalue(DenseMatrix::Identity(4, 4)), Interrupted);
}

TEST_CASE("the greatest eigenvalue of the chain's stiffness, in closed form") {
  const int n = 200;
  DenseMatrix K = DenseMatrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    if (i) K(i, i - 1) = K(i - 1, i) = -1;
  }
  const double value = 2 + 2 * std::cos(std::acos(-1.0) / (n + 1));
  CHECK(algebra::largest_eigenvalue(K) >= value);
  CHECK(algebra::largest_eigenvalue(K) <= 4);  // the row sum
}

TEST_CASE("nothing, zero, and the identity") {
  CHECK(algebra::largest_eigenvalue(DenseMatrix(0, 0)) == 0);
  CHECK(algebra::largest_eigenvalue(DenseMatrix::Zero(4, 4)) == 0);
  CHECK(algebra::largest_eigenvalue(DenseMatrix::Identity(4, 4)) == doctest::Approx(1));
}

TEST_CASE("both ends of a spectrum; parts of it that the start has no part in are not seen") {
  const Vector eigenvalues{{0, 1, 2, 5, 9, 100}};
  const auto A = [&](const Vector& v) -> Vector { return eigenvalues.cwiseProduct(v); };
  const auto all = algebra::lanczos(A, Vector::Ones(6), 60, algebra::Ends::both);
  CHECK(all.steps == 6);
  CHECK(std::abs(all.least) < 1e-13);
  CHECK(all.greatest == doctest::Approx(100).epsilon(1e-13));
  const auto some = algebra::lanczos(A, Vector{{0, 1, 0, 2, 3, 0}}, 60, algebra::Ends::both);
  CHECK(some.steps == 3);
  CHECK(some.least == doctest::Approx(1).epsilon(1e-12));
  CHECK(some.greatest == doctest::Approx(9).epsilon(1e-12));
  CHECK(some.greatest_residual < 1e-12);
  const auto few = algebra::lanczos(A, Vector::Ones(6), 2, algebra::Ends::both);
  CHECK(few.greatest < 100);
  CHECK(few.bound() >= 100);
  CHECK(algebra::lanczos(A, Vector::Zero(6), 60, algebra::Ends::both).steps == 0);
}
