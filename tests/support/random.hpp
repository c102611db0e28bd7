#pragma once

#include <Eigen/Core>
#include <random>

#include "algebra/types.hpp"

namespace dotyk::test {

/// Numbers that look random and are the same in every run: one generator a test, with its own seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// Uniform in [a, b).
  double between(double a, double b) { return a + (b - a) * (engine_() >> 8) / 16777216.0; }
  /// Uniform in {0, …, n − 1}.
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool coin() { return below(2) == 1; }

  algebra::Vector vector(int n) {
    algebra::Vector v(n);
    for (double& x : v) x = between(-1, 1);
    return v;
  }
  algebra::DenseMatrix matrix(int rows, int columns) {
    algebra::DenseMatrix m(rows, columns);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) m(i, j) = between(-1, 1);
    return m;
  }
  /// Symmetric, eigenvalues from `least` up to some n.
  algebra::DenseMatrix positive_definite(int n, double least) {
    const algebra::DenseMatrix a = matrix(n, n);
    return a * a.transpose() + least * algebra::DenseMatrix::Identity(n, n);
  }

 private:
  std::mt19937 engine_;
};

/// The lower triangle as a sparse matrix; zeros off the diagonal are left out.
inline algebra::SparseMatrix lower(const algebra::DenseMatrix& a) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < a.cols(); ++j)
    for (int i = j; i < a.rows(); ++i)
      if (i == j || a(i, j) != 0) entries.emplace_back(i, j, a(i, j));
  algebra::SparseMatrix result(a.rows(), a.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Both triangles of a sparse lower one.
inline algebra::DenseMatrix full(const algebra::SparseMatrix& lower_triangle) {
  return algebra::DenseMatrix(algebra::DenseMatrix(lower_triangle).selfadjointView<Eigen::Lower>());
}

inline double relative(const algebra::DenseMatrix& a, const algebra::DenseMatrix& b) {
  return (a - b).norm() / b.norm();
}

}  // namespace dotyk::test
