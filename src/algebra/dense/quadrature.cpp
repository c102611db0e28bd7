#include "algebra/dense/quadrature.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace dotyk::algebra {

Quadrature gauss(int count, double power) {
  Vector diagonal(count), off(count - 1);
  for (int n = 0; n < count; ++n) {
    const double m = 2.0 * n + power;
    diagonal(n) = n == 0 ? power / (power + 2) : power * power / (m * (m + 2));
    if (n > 0) off(n - 1) = 2.0 * n * (n + power) / (m * std::sqrt(m * m - 1));
  }
  Eigen::SelfAdjointEigenSolver<DenseMatrix> jacobi;
  jacobi.computeFromTridiagonal(diagonal, off);
  return {(jacobi.eigenvalues().array() + 1) / 2,
          jacobi.eigenvectors().row(0).transpose().array().square() / (power + 1)};
}

}  // namespace dotyk::algebra
