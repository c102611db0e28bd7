#include "algebra/dense/bounded_least_squares.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "../support/random.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

DenseMatrix random_matrix(test::Random& random, int rows, int columns) {
  DenseMatrix A(rows, columns);
  for (int j = 0; j < columns; ++j) A.col(j) = random.vector(rows);
  return A;
}

}  // namespace

TEST_CASE("bounded least squares meets its optimality conditions on random data") {
  test::Random random(201);
  for (int trial = 0; trial < 400; ++trial) {
    const int rows = 1 + trial % 6, columns = 1 + trial % 40;
    const DenseMatrix A = random_matrix(random, rows, columns);
    const Vector b = random.vector(rows);
    Vector low(columns), high(columns);
    for (int j = 0; j < columns; ++j) {  // x ≥ 0, boxed, bounded above, free
      const int kind = (trial + j) % 4;
      low[j] = kind == 0 ? 0 : kind == 1 ? -0.2 : -kNoBound;
      high[j] = kind == 0 || kind == 3 ? kNoBound : 0.1;
    }
    const auto s = algebra::bounded_least_squares(A, b, low, high);
    CHECK((b - A * s.x - s.residual).norm() < 1e-12);
    const Vector slope = A.transpose() * s.residual;  // minus the gradient
    for (int j = 0; j < columns; ++j) {
      CHECK(s.x[j] >= low[j]);
      CHECK(s.x[j] <= high[j]);
      if (s.x[j] > low[j]) CHECK(slope[j] > -1e-9);
      if (s.x[j] < high[j]) CHECK(slope[j] < 1e-9);
    }
  }
}

TEST_CASE("the residual of nonnegative least squares is the projection onto the polar cone") {
  // Columns (1,0) and (0,1) carry the first quadrant: what is left of b lies in the others.
  const DenseMatrix A = DenseMatrix::Identity(2, 2);
  const Vector zero = Vector::Zero(2), none = Vector::Constant(2, kNoBound);
  CHECK(algebra::bounded_least_squares(A, Vector{{1, -2}}, zero, none).residual.isApprox(Vector{{0, -2}}));
  CHECK(algebra::bounded_least_squares(A, Vector{{-1, -2}}, zero, none).residual.isApprox(Vector{{-1, -2}}));
  CHECK(algebra::bounded_least_squares(A, Vector{{3, 2}}, zero, none).residual.norm() == 0);
}

TEST_CASE("columns that repeat or vanish do not disturb") {
  DenseMatrix A = DenseMatrix::Zero(3, 200);
  for (int j = 0; j < 200; ++j) A(j % 2, j) = 1;  // third row never reached
  const auto s = algebra::bounded_least_squares(A, Vector{{1, 2, 3}}, Vector::Zero(200), Vector::Constant(200, kNoBound));
  CHECK(s.residual.isApprox(Vector{{0, 0, 3}}));
  const auto empty = algebra::bounded_least_squares(DenseMatrix(3, 0), Vector{{1, 2, 3}}, Vector(0), Vector(0));
  CHECK(empty.residual.isApprox(Vector{{1, 2, 3}}));
}

TEST_CASE("bounds far beyond what is needed leave no rounding of their size") {
  const DenseMatrix A{{1, 0, 1}, {0, 1, 1}};
  const Vector b{{0.3, -0.7}};
  for (const double far : {1e3, 1e8, 1e15, kNoBound}) {
    CAPTURE(far);
    CHECK(algebra::bounded_least_squares(A, b, Vector::Constant(3, -far), Vector::Constant(3, far)).residual.norm() < 1e-15);
  }
}
