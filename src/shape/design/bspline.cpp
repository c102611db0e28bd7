#include "shape/design/bspline.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dotyk::shape {

BSplines::BSplines(int degree, int count, Ends ends) : degree_(degree), count_(count), ends_(ends) {
  if (degree < 1 || degree > 3) throw InputError(text("the degree of B-splines is ", degree, "; it must be 1, 2 or 3"));
  if (count <= degree) throw InputError(text("B-splines of degree ", degree, " with ", count, " control points; they need at least ", degree + 1));
}

/// In spans. Periodic: no knot is repeated, those outside belong to the spans that come again.
double BSplines::knot(int k) const {
  const double at = k - degree_;
  return ends_ == Ends::periodic ? at : std::clamp(at, 0.0, static_cast<double>(count_ - degree_));
}

algebra::Vector BSplines::values(double t) const {
  const int spans = ends_ == Ends::periodic ? count_ : count_ - degree_;
  const double s = std::clamp(t, 0.0, 1.0) * spans;
  const int span = std::min(static_cast<int>(s), spans - 1) + degree_;  // knot(span) ≤ s ≤ knot(span + 1)
  double n[4] = {1, 0, 0, 0};  // of the splines span − p … span, degree p raised from 0 by Cox and de Boor's recursion
  for (int p = 1; p <= degree_; ++p) {
    double carried = 0;
    for (int r = 0; r < p; ++r) {
      const double right = knot(span + r + 1), left = knot(span + r + 1 - p);
      const double share = n[r] / (right - left);
      n[r] = carried + (right - s) * share;
      carried = (s - left) * share;
    }
    n[p] = carried;
  }
  algebra::Vector all = algebra::Vector::Zero(count_);
  for (int r = 0; r <= degree_; ++r) all[(span - degree_ + r) % count_] += n[r];
  return all;
}

algebra::DenseMatrix symmetric_ties(int count) {
  algebra::DenseMatrix ties = algebra::DenseMatrix::Zero(count, (count + 1) / 2);
  for (int i = 0; i < count; ++i) ties(i, std::min(i, count - 1 - i)) = 1;
  return ties;
}

}  // namespace dotyk::shape
