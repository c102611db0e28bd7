#include "algebra/dense/quadrature.hpp"

#include <cmath>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::algebra {

Quadrature gauss(int count, double power) {
  Vector diagonal(count), off(count - 1);
  for (int n = 0; n < count; ++n) {
    const double m = 2.0 * n + power;
    diagonal(n) = n == 0 ? power / (power + 2) : power * power / (m * (m + 2));
    if (n > 0) off(n - 1) = 2.0 * n * (n + power) / (m * std::sqrt(m * m - 1));
  }
  const Eigenpairs jacobi = tridiagonal_eigenpairs(diagonal, off);
  return {(jacobi.values.array() + 1) / 2,
          jacobi.vectors.row(0).transpose().array().square() / (power + 1)};
}

}  // namespace dotyk::algebra
