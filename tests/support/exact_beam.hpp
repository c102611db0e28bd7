#pragma once

// Beams of constant EJ under a constant load between two ends, solved in closed form.
#include <array>

#include <Eigen/LU>

#include "beam/solve.hpp"
#include "plain_laws.hpp"

namespace dotyk::test {

inline constexpr double kLength = 2, kEJ = 3;  ///< of the beams compared

/// One condition of an end: r = force − stiffness·v, or v = value (rigid).
struct EndCondition {
  bool rigid = false;
  double value = 0, force = 0, stiffness = 0;
};

/// u = qx⁴/24EJ + a₃x³ + a₂x² + a₁x + a₀ with the conditions (left deflection, left rotation, right deflection, right
/// rotation): EJu‴(0) and −EJu″(0) are the force and the moment on the left end, −EJu‴(L) and EJu″(L) those on the right.
class ExactBeam {
 public:
  ExactBeam(double length, double EJ, double q, const std::array<EndCondition, 4>& conditions) : EJ_(EJ), q_(q) {
    Eigen::Matrix4d A;
    Eigen::Vector4d b;
    for (int i = 0; i < 4; ++i) {
      const double x = i < 2 ? 0 : length;
      const int derivative = i % 2;
      const double sign = i == 0 || i == 3 ? 1 : -1;
      Eigen::Vector4d v, r;
      for (int j = 0; j < 4; ++j) v[j] = power(j, derivative, x), r[j] = sign * EJ * power(j, 3 - derivative, x);
      const double v0 = q / (24 * EJ) * power(4, derivative, x), r0 = sign * q / 24 * power(4, 3 - derivative, x);
      const EndCondition& c = conditions[i];
      A.row(i) = c.rigid ? v : Eigen::Vector4d(r + c.stiffness * v);
      b[i] = c.rigid ? c.value - v0 : c.force - c.stiffness * v0 - r0;
    }
    a_ = A.fullPivLu().solve(b);
  }
  /// The derivative of u of that order.
  double u(double x, int derivative = 0) const {
    double sum = q_ / (24 * EJ_) * power(4, derivative, x);
    for (int j = 0; j < 4; ++j) sum += a_[j] * power(j, derivative, x);
    return sum;
  }
  double moment(double x) const { return -EJ_ * u(x, 2); }
  double shear(double x) const { return -EJ_ * u(x, 3); }

 private:
  static double power(int n, int derivative, double x) {
    double value = 1;
    for (int k = 0; k < derivative; ++k) value *= n - k;
    for (int k = derivative; k < n; ++k) value *= x;
    return value;
  }
  double EJ_, q_;
  Eigen::Vector4d a_;
};

inline beam::Beam beam_between(double length, double EJ, double q, problem::LawChoice left_deflection, problem::LawChoice left_rotation,
                               problem::LawChoice right_deflection, problem::LawChoice right_rotation) {
  beam::Beam b;
  b.length = length;
  b.EJ = EJ;
  b.q = q;
  b.supports = {{"left", 0, left_deflection, left_rotation}, {"right", length, right_deflection, right_rotation}};
  return b;
}

inline std::shared_ptr<const beam::Solution> only(const beam::Beam& beam, const solver::Method& method = {}) {
  Monitor monitor;
  return beam::solve(beam, method, monitor).front().solution;
}

}  // namespace dotyk::test
