#include "algebra/symmetric_matrix.hpp"

#include <doctest/doctest.h>

#include "../support/one_core.hpp"
#include "algebra/congruent.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Enough entries for three threads.
SparseMatrix large() { return test::laplacian(100, 100, 80, 3); }

}  // namespace

TEST_CASE("a symmetric product is that of the full matrix, on one core and on several") {
  const SparseMatrix lower = large();
  REQUIRE(lower.nonZeros() > 3'000'000);
  test::Random random(5);
  const Vector v = random.vector(static_cast<int>(lower.cols())), w = random.vector(static_cast<int>(lower.cols()));
  const Vector by_eigen = lower.selfadjointView<Eigen::Lower>() * v;
  const auto compare = [&] {
    CHECK(test::relative(algebra::symmetric_product(lower, v), by_eigen) < 1e-15);
    using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
    CHECK(test::relative(Vector(algebra::symmetric_product(lower, LongVector(v.cast<long double>())).cast<double>()), by_eigen) < 1e-15);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> both(v.size(), 2);
    both << v, w;
    const auto products = algebra::symmetric_product(lower, both);
    CHECK(test::relative(Vector(products.col(0)), by_eigen) < 1e-15);
    CHECK(test::relative(Vector(products.col(1)), Vector(lower.selfadjointView<Eigen::Lower>() * w)) < 1e-15);
    const SparseMatrix modulus = lower.cwiseAbs();
    CHECK(test::relative(algebra::symmetric_product(lower, v, [](double a) { return std::abs(a); }), Vector(modulus.selfadjointView<Eigen::Lower>() * v)) < 1e-15);
  };
  compare();
  const test::OneCore one;
  CHECK(cores() == 1);
  compare();
}

TEST_CASE("PᵀAP is the same to the last bit on one core and on several") {
  const SparseMatrix lower = large();
  algebra::Triplets entries;
  test::Random random(6);
  for (int i = 0; i < lower.rows(); ++i)
    for (int k = 0; k < 2; ++k) entries.emplace_back(i, i / 8 + random.below(2) * (i / 8 < lower.rows() / 8 - 1), random.between(0, 1));
  const auto P = algebra::from_triplets(lower.rows(), lower.rows() / 8, entries);
  const SparseMatrix several = algebra::congruent(lower, P);
  const test::OneCore core;
  const SparseMatrix one = algebra::congruent(lower, P);
  REQUIRE(one.nonZeros() == several.nonZeros());
  CHECK(std::equal(one.valuePtr(), one.valuePtr() + one.nonZeros(), several.valuePtr()));
  CHECK(std::equal(one.innerIndexPtr(), one.innerIndexPtr() + one.nonZeros(), several.innerIndexPtr()));
}

TEST_CASE("PᵀAP is that of dense matrices: components of nodes alike, some of them, none") {
  test::Random random(8);
  constexpr int kNodes = 24, kCoarse = 7;
  for (const int components : {1, 2, 3, 4})
    for (const double dropped : {0.0, 0.2, 0.7}) {  // entries of A, so that columns of a node are not alike, or empty, and of P
      const int n = kNodes * components, m = kCoarse * components;
      algebra::DenseMatrix A = algebra::DenseMatrix::Zero(n, n), P = algebra::DenseMatrix::Zero(n, m);
      const auto kept = [&] { return random.between(0, 1) >= dropped; };
      for (int a = 0; a < kNodes; ++a)
        for (int b = std::max(0, a - 3); b <= a; ++b)
          for (int i = 0; i < components; ++i)
            for (int j = 0; j < components; ++j)
              if (const int r = a * components + i, c = b * components + j; c <= r && kept()) A(r, c) = A(c, r) = random.between(-1, 1);
      for (int a = 0; a < kNodes; ++a)
        for (int k = 0; k < 2; ++k) {
          const double factor = random.between(0.1, 1);
          const int J = std::min(kCoarse - 1, a * kCoarse / kNodes + k);
          for (int i = 0; i < components; ++i)
            if (kept()) P(a * components + i, J * components + i) = factor;
        }
      const SparseMatrix lower = algebra::DenseMatrix(A.triangularView<Eigen::Lower>()).sparseView(), sparse = P.sparseView();
      const SparseMatrix product = algebra::congruent(lower, sparse), by_rows = algebra::congruent(lower, algebra::SparseRows(sparse));
      const algebra::DenseMatrix exact = (P.transpose() * A * P).eval().triangularView<Eigen::Lower>();
      CAPTURE(components);
      CAPTURE(dropped);
      CHECK((algebra::DenseMatrix(product) - exact).lpNorm<Eigen::Infinity>() <= 1e-14 * exact.lpNorm<Eigen::Infinity>());
      CHECK((algebra::DenseMatrix(by_rows) - algebra::DenseMatrix(product)).norm() == 0);
      for (int j = 0; j < m; ++j) {
        int before = j - 1;  // rows ascend, from the diagonal on
        for (SparseMatrix::InnerIterator it(product, j); it; ++it) {
          CHECK(it.row() > before);
          before = static_cast<int>(it.row());
        }
      }
    }
}
