#pragma once

#include <vector>

#include "channel/closed_form.hpp"
#include "channel/data.hpp"
#include "algebra/types.hpp"

namespace dotyk::channel {

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
