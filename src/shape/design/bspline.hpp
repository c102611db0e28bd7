#pragma once

#include "algebra/types.hpp"

namespace dotyk::shape {

/// The B-splines of a degree, 1 to 3, on [0, 1] with equally long knot spans: a nonnegative partition of unity,
/// degree − 1 times continuously differentiable.
class BSplines {
 public:
  /// `open`: ends have knots of multiplicity degree + 1, so that the first and last control point are the ends of a curve;
  /// `periodic`: one closed curve, t = 0 and 1 are the same.
  enum class Ends { open, periodic };

  /// Throws InputError for a degree outside 1…3 and for fewer than degree + 1 control points.
  BSplines(int degree, int count, Ends ends = Ends::open);

  int count() const { return count_; }
  /// The values of all of them (count) at t, 0 ≤ t ≤ 1.
  algebra::Vector values(double t) const;

 private:
  double knot(int k) const;

  int degree_, count_;
  Ends ends_;
};

/// count × ⌈count/2⌉ of zeros and ones: control points i and count − 1 − i made one variable.
algebra::DenseMatrix symmetric_ties(int count);

}  // namespace dotyk::shape
