#pragma once

#include "algebra/types.hpp"

namespace dotyk::channel {

/// alpha_k = (2k + 1) pi/2, k = 0 ... count - 1; the eigenfunctions (28) are cos(alpha_k y/y0).
Eigen::ArrayXd wave_numbers(int count);

/// Coefficients (35) of 1 - |s|^p, s = y/y0, p >= 0, in cos(alpha_k s):
///
///   C_k = 2 p/alpha_k J_k,   J_k = int_0^1 s^{p-1} sin(alpha_k s) ds.
///
/// For alpha_k < limit J_k comes from Gauss-Jacobi quadrature with weight s^p; beyond, from turning the
/// path of integration into the complex plane,
///   J_k = Gamma(p) sin(p pi/2)/alpha^p + (-1)^k Im A/alpha,  A = int_0^oo (1 + i r/alpha)^{p-1} e^{-r} dr,
/// and A from its asymptotic series, of which terms down to e^{-alpha} can be used.
Eigen::ArrayXd initial_coefficients(double p, int count);

/// The least alpha beyond which coefficient_bound holds: max(40, 2p).
double asymptotic_limit(double p);

/// |C_k| <= smooth/alpha^3 + cusp/alpha^{p+1} for alpha >= asymptotic_limit(p): smooth = 4 p |p - 1|
/// (as |Im A| <= 2 |p - 1|/alpha there), cusp = 2 Gamma(p + 1) |sin(p pi/2)|.
struct CoefficientBound {
  double smooth = 0, cusp = 0;
};
CoefficientBound coefficient_bound(double p);

}  // namespace dotyk::channel
