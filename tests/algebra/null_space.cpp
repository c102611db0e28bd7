#include "algebra/dense/null_space.hpp"

#include <doctest/doctest.h>

#include <random>

#include "algebra/dense/dense.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::SparseMatrix;

TEST_CASE("the null space of small and large pieces is that of singular values") {
  std::mt19937 engine(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (const int columns : {3, 20, 60, 120})
    for (int trial = 0; trial < 10; ++trial) {
      CAPTURE(columns);
      CAPTURE(trial);
      const int rows = columns - trial;
      DenseMatrix A = DenseMatrix::NullaryExpr(rows > 0 ? rows : 1, columns, [&] { return uniform(0, 1) < 0.8 ? 0.0 : uniform(-1, 1); });
      if (trial % 2) A.col(columns - 1) = A.col(0) + 2 * A.col(1);
      const SparseMatrix sparse = A.sparseView();
      const auto two = algebra::range_and_null(sparse, 1e-9);
      const algebra::Vector s = algebra::singular_values(A);
      const auto rank = (s.array() > 1e-9 * std::max(1.0, s[0])).count();
      CHECK(two.seen.cols() == rank);
      CHECK(two.unseen.cols() == columns - rank);
      CHECK(algebra::rank(sparse, 1e-9) == rank);
      const DenseMatrix unseen = two.unseen;
      if (unseen.cols() > 0) {
        CHECK((A * unseen).norm() <= 1e-9);
        CHECK((unseen.transpose() * unseen - DenseMatrix::Identity(unseen.cols(), unseen.cols())).norm() <= 1e-11);
      }
      DenseMatrix whole(columns, columns);
      whole << DenseMatrix(two.seen), unseen;
      CHECK(algebra::smallest_singular_value(whole) > 1e-6);
    }
}
