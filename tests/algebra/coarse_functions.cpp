#include "algebra/coarse_functions.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace dotyk;
using algebra::CoarseFunctions;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Five nodes of a line, each with two components; the coarser mesh has nodes 0, 2 and 4. The first component of node 0 is prescribed.
CoarseFunctions of_line() {
  const auto means = std::make_shared<const Buckets>(5, [](auto&& put) {
    for (int i = 0; i < 5; ++i) {
      put(i, i / 2);
      if (i % 2) put(i, i / 2 + 1);
    }
  });
  return {2, means, std::vector<int>{-1, 0, 1, 2, 3, 4, 5, 6, 7, 8}, std::vector<int>{-1, 1, 2, 3, 4, 5}, 9, 6};
}

SparseRows matrix(const CoarseFunctions& functions) {
  SparseRows P;
  functions.to_matrix(P);
  return P;
}

}  // namespace

TEST_CASE("coarse functions are the matrix that they stand for") {
  const CoarseFunctions functions = of_line();
  algebra::DenseMatrix expected = algebra::DenseMatrix::Zero(9, 6);
  expected(0, 1) = expected(3, 2) = expected(4, 3) = expected(7, 4) = expected(8, 5) = 1;
  expected(1, 2) = 0.5;  // the other half is prescribed
  for (const auto& [row, a, b] : {std::array{2, 1, 3}, {5, 2, 4}, {6, 3, 5}}) expected(row, a) = expected(row, b) = 0.5;
  CHECK(algebra::DenseMatrix(matrix(functions)) == expected);
  const Vector coarse = Vector::LinSpaced(6, 1, 6), fine = Vector::LinSpaced(9, -2, 3);
  CHECK((functions.times(coarse) - expected * coarse).norm() < 1e-15);
  CHECK((functions.transposed_times(fine) - expected.transpose() * fine).norm() < 1e-15);
  CHECK(functions.at_coarse(fine) == Vector{{0, fine[0], fine[3], fine[4], fine[7], fine[8]}});
}

TEST_CASE("columns that have no entries are left out, and the others keep their order") {
  const CoarseFunctions functions = of_line(), compact = functions.compact();
  CHECK(compact.columns == 5);
  CHECK(algebra::DenseMatrix(matrix(compact)) == algebra::DenseMatrix(matrix(functions)).rightCols(5));
  const CoarseFunctions next{2, nullptr, compact.column, functions.column, 5, 6};  // each node is its own
  CHECK(algebra::DenseMatrix(matrix(next)) == algebra::DenseMatrix::Identity(6, 6).bottomRows(5));
}
