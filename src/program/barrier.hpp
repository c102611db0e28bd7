#pragma once

#include <vector>

#include "program/kkt.hpp"

namespace dotyk::program {

/// The iterate of a primal–dual interior-point method for a (scaled) program, and its steps: predictor
/// (Mehrotra 1992), centrality corrections (Gondzio 1996), quasidefinite KKT systems with refinement.
class Barrier {
 public:
  explicit Barrier(const QuadraticProgram& program);

  /// x, the activities w of the rows, and slack s and multiplier z ≥ 0 of their finite limits; y = z_u − z_l
  /// but for equalities. Slacks are unknowns of their own: w − low would lose its digits.
  struct Point {
    Vector x, y, w, sl, su, zl, zu;
  };

  /// Multipliers start `far` inside: too near zero they shrink the first steps.
  void start(double far);
  /// Residuals at the point.
  void evaluate();
  /// The largest of the residuals, relative, and of the gap.
  double merit() const;
  /// False where the KKT system cannot be factored or the step is not finite.
  bool step();
  /// Rows whose multiplier exceeds their slack at a point: the active set it predicts.
  std::vector<Side> active(const Point& at) const;

  const Point& point() const { return at_; }
  /// The last step's direction: of iterates that go to infinity it is the cleaner proof.
  const Point& last() const { return last_; }
  int factorisations() const { return factorisations_; }

 private:
  bool factor(const Vector& theta_inverse, double least);
  Vector solve(const Vector& f, const Vector& h, const Vector& theta_inverse) const;
  Point zero() const;
  Point direction(const Vector& theta_inverse, Vector cl, Vector cu) const;
  double longest(const Point& d) const;
  void centre(const Point& d, double reach, double aim, Vector& cl, Vector& cu) const;

  const QuadraticProgram& p_;
  int n_, m_, limits_ = 0, factorisations_ = 0;
  Kkt kkt_;
  std::vector<char> taken_, has_low_, has_high_;
  Vector D_, rd_, rp_, rl_, ru_;  ///< residuals: stationarity, Ax = w, the two slacks
  Point at_, last_;
  double regular_ = 0, mu_ = 0, primal_ = 0, dual_ = 0, gap_ = 0, size_b_ = 0;
};

}  // namespace dotyk::program
