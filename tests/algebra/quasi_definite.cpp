#include <doctest/doctest.h>

#include "../support/random.hpp"
#include "algebra/direct/indefinite.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::QuasiDefinite;
using algebra::Vector;
using test::Random;

TEST_CASE("a quasidefinite matrix is solved in any order, and its negative eigenvalues are counted") {
  Random random(81);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 1 + trial % 12, m = trial % 7;
    DenseMatrix K(n + m, n + m);
    const DenseMatrix G = random.matrix(m, n);
    K << random.positive_definite(n, 0.1), G.transpose(), G, -random.positive_definite(m, 0.1);
    QuasiDefinite factor(test::lower(K));
    REQUIRE(factor.factor(test::lower(K)));
    CHECK(factor.negative_pivots() == m);
    const Vector b = random.vector(n + m);
    CHECK((K * factor.solve(b) - b).norm() < 1e-12 * b.norm() * K.norm() * 1e2);
    const Vector v = factor.negative_direction();
    CHECK(v.size() == (m ? n + m : 0));
    if (m) CHECK(v.dot(K * v) < 0);
  }
}

TEST_CASE("a zero pivot is told; a matrix without unknowns is no trouble") {
  DenseMatrix K(2, 2);
  K << 0, 0, 0, 1;
  QuasiDefinite factor(test::lower(K));
  CHECK_FALSE(factor.factor(test::lower(K)));
  QuasiDefinite empty(algebra::SparseMatrix(0, 0));
  CHECK(empty.factor(algebra::SparseMatrix(0, 0)));
  CHECK(empty.solve(Vector(0)).size() == 0);
}
