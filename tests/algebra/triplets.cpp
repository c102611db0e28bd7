#include <doctest/doctest.h>

#include "algebra/types.hpp"

using namespace dotyk;

namespace {

/// As Eigen does it.
template <class Matrix>
Matrix by_eigen(int rows, int columns, const algebra::Triplets& entries) {
  Matrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Matrix>
void compare(int rows, int columns, const algebra::Triplets& entries) {
  const auto matrix = algebra::from_triplets<Matrix>(rows, columns, entries), expected = by_eigen<Matrix>(rows, columns, entries);
  CHECK(matrix.isCompressed());
  REQUIRE(matrix.rows() == rows);
  REQUIRE(matrix.cols() == columns);
  REQUIRE(matrix.nonZeros() == expected.nonZeros());
  CHECK(std::equal(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1, expected.outerIndexPtr()));
  CHECK(std::equal(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros(), expected.innerIndexPtr()));
  CHECK(std::equal(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), expected.valuePtr()));
}

}  // namespace

TEST_CASE("few triplets make the matrix that Eigen makes of them, and so do many") {
  // Sums that depend on the order: 1e16 + 1 − 1e16 is 0, and 1e16 − 1e16 + 1 is 1.
  const algebra::Triplets few{{2, 900, 1e16}, {0, 5, 3.0}, {2, 900, 1.0}, {2, 7, 4.0}, {2, 900, -1e16}, {0, 999, 1e16}, {0, 999, -1e16}, {0, 999, 1.0}};
  algebra::Triplets across;
  for (const auto& e : few) across.emplace_back(e.col(), e.row(), e.value());
  for (const int wide : {1000, 60}) {  // above ten times the entries, and below
    algebra::Triplets some = few;
    for (auto& e : some) e = {e.row(), e.col() % wide, e.value()};
    compare<algebra::SparseRows>(4, wide, some), compare<algebra::SparseMatrix>(4, wide, some);
  }
  compare<algebra::SparseRows>(1000, 4, across), compare<algebra::SparseMatrix>(1000, 4, across);
  compare<algebra::SparseRows>(3, 50, {}), compare<algebra::SparseMatrix>(0, 50, {}), compare<algebra::SparseRows>(0, 0, {});
}
