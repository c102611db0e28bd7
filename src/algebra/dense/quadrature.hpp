#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// int_0^1 s^power f(s) ds = sum w_i f(s_i), exact for polynomials f of degree 2 count - 1.
struct Quadrature {
  Vector points, weights;
};

/// Gauss-Jacobi by the eigenvalues of the Jacobi matrix (Golub and Welsch); power > -1, 0 is
/// Gauss-Legendre.
Quadrature gauss(int count, double power = 0);

}  // namespace dotyk::algebra
