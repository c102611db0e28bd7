#include "algebra/krylov/lanczos_record.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/krylov/conjugate_basis.hpp"

namespace dotyk::algebra {

void LanczosRecord::append(const Vector& r) {
  grow(q_, r.size(), steps_);
  norm_ = r.norm();
  if (norm_ > 0) q_.col(steps_) = r / norm_;
  else q_.col(steps_).setZero();
}

void LanczosRecord::start(const Vector& r) {
  *this = {};
  append(r);
}

void LanczosRecord::advance(double alpha, Vector& r) {
  if (diagonal_.size() <= steps_) {
    diagonal_.conservativeResize(2 * steps_ + 16);
    off_.conservativeResize(2 * steps_ + 16);
  }
  const auto known = q_.leftCols(steps_ + 1);
  const Vector part = known.transpose() * r;
  if (r.norm() > 0) loss_ = std::max(loss_, part.cwiseAbs().maxCoeff() / r.norm());
  r -= known * part;
  diagonal_[steps_] = 1 / alpha + (steps_ > 0 ? beta_ / alpha_ : 0);
  const double before = norm_;
  off_[steps_++] = -r.norm() / (alpha * before);
  append(r);
  alpha_ = alpha;
  beta_ = std::pow(norm_ / before, 2);
}

}  // namespace dotyk::algebra
