#pragma once

#include <complex>
#include <vector>

#include "channel/data.hpp"
#include "algebra/types.hpp"

namespace dotyk::channel {

using Complex = std::complex<double>;

/// h(y) of gamma h - b h'' = 1, h(+-y0) = 0, |y| <= y0, b > 0, Re gamma >= 0:
///
///   h = (1 - cosh(m y)/cosh(m y0))/gamma,  m^2 = gamma/b;   (y0^2 - y^2)/(2b) for gamma = 0.
///
/// gamma = c: the profile of the steady channel for a unit force, (39) off the axis.
/// gamma = c + i a w: Re(h e^{iwt}) is the periodic solution for the force cos wt, the closed sum of (38).
/// Computed without cancellation for small m and without overflow for large.
Complex forced_profile(double y, double y0, double b, Complex gamma);

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

/// u(y, t) of the modified Hartmann problem: the periodic state in closed form and the transient as a
/// series in cos(alpha_k y/y0) (28), (30), (35), so that only what dies out is ever truncated.
///
/// With g(t) = c sin(2wt)/(4aw) and c' = c/2 for the second combination of fields (g = 0, c' = c for the
/// first), v = e^g u has the constant coefficients
///   a v_t - b v_yy + c' v = e^{g(t)} (d + drive cos wt) = Re sum_n F_n e^{inwt},
/// F_n the Fourier coefficients (n >= 0, those of n and -n added up), and
///   v = Re sum_n F_n h_n(y) e^{inwt} + sum_k T_k e^{-lambda_k t} cos(alpha_k y/y0),
/// h_n the closed form for gamma = c' + i a n w, lambda_k = (b alpha_k^2/y0^2 + c')/a (29), and
///   T_k = C_k - Re sum_n F_n f_k/(b alpha_k^2/y0^2 + c' + i a n w),  f_k = 2 (-1)^k/alpha_k,
/// C_k of (35). For one field this is (30) + (38) with the transient that (38) lacks.
class Series {
 public:
  /// Throws InputError as check(), and where B oscillates so slowly that e^g takes the digits away
  /// (c/(4aw) > 6): stepping treats these.
  explicit Series(const Data& data, int terms = 4096);

  /// Throws InputError for |y| > y0, t < 0 or nan. At t = 0 the initial profile itself.
  double velocity(double y, double t) const;

  /// What velocity() tends to.
  double periodic(double y, double t) const;

  /// Amplitude of the part of periodic() that varies as cos(wt + phase); |drive h_1| for the first combination.
  double amplitude(double y) const;

  /// Terms summed at time t: the fewest whose bound is below 1e-16 of the greatest speed, or all.
  int terms_used(double t) const;

  /// |velocity - sum of the whole series| at time t, for all y, with n terms (or those used):
  ///   e^{-g} sum_{k >= n} |T_k| e^{-lambda_k t},  |T_k| <= A/alpha_k^3 + B/alpha_k^{p+1}  (coefficient_bound),
  /// each power summed as its first term times min(1 + alpha_n/((q - 1) pi), 1/(1 - r)), the integral or
  /// the geometric majorant, r = e^{-2 pi alpha_n b t/(a y0^2)}. Rounding is not in it.
  double truncation_bound(double t, int n) const;
  double truncation_bound(double t) const;

  const Data& data() const { return data_; }

 private:
  struct Harmonic {
    int n;
    Complex force;  // F_n
    Complex gamma;
  };
  void find_harmonics();
  void find_transient(int terms);
  double logarithm(double t) const;  // g
  void check(double y, double t) const;
  double tail(double t, int n) const;

  Data data_;
  double growth_ = 0;      // c/(4aw), the amplitude of g
  double resistance_ = 0;  // c'
  double scale_ = 0;       // about the greatest speed
  double exponent_ = 0;    // p
  double smooth_ = 0, cusp_ = 0;  // A, B
  int first_bounded_ = 0;         // from which k they hold
  std::vector<Harmonic> harmonics_;
  Eigen::ArrayXd alpha_, transient_, lambda_;
};

/// The steady channel -b u'' + c u = d under the constant field B0: Hartmann's profile (39), off the axis too.
double stationary(const Data& data, double y);

}  // namespace dotyk::channel
