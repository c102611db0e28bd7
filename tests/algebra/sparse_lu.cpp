#include "algebra/direct/indefinite.hpp"

#include <doctest/doctest.h>

#include "../support/random.hpp"

using namespace dotyk;
using namespace dotyk::algebra;

namespace {

SparseMatrix sparse(const DenseMatrix& a) { return a.sparseView(); }

}  // namespace

TEST_CASE("sparse LU solves saddle points as dense LU does") {
  test::Random random(31);
  for (int n : {1, 4, 30}) {
    const int m = n / 2;
    DenseMatrix A = DenseMatrix::Zero(n + m, n + m);
    A.topLeftCorner(n, n) = random.positive_definite(n, 0.5);
    A.topRightCorner(n, m) = random.matrix(n, m);
    A.bottomLeftCorner(m, n) = A.topRightCorner(n, m).transpose();
    const SparseMatrix a = sparse(A);
    const SparseLu lu(a);
    REQUIRE_FALSE(lu.singular());
    const Vector b = random.vector(n + m);
    CHECK(test::relative(A * lu.solve(b), b) < 1e-11);
  }
}

TEST_CASE("sparse LU flags singular matrices, exact and to rounding") {
  test::Random random(32);
  DenseMatrix repeated = random.matrix(6, 6);
  repeated.row(4) = repeated.row(1);
  const SparseMatrix a = sparse(repeated);
  CHECK(SparseLu(a).singular());
  DenseMatrix empty_row = random.matrix(6, 6);
  empty_row.row(2).setZero();
  const SparseMatrix b = sparse(empty_row);
  CHECK(SparseLu(b).singular());
  DenseMatrix sums = random.matrix(6, 6);
  sums.row(5) = sums.row(0) + sums.row(1) - 3 * sums.row(2);
  const SparseMatrix c = sparse(sums);
  CHECK(SparseLu(c).singular());
}

TEST_CASE("sparse LU of nothing solves nothing") {
  const SparseMatrix none(0, 0);
  const SparseLu lu(none);
  CHECK_FALSE(lu.singular());
  CHECK(lu.solve(Vector()).size() == 0);
}
