#include "algebra/krylov/kept_vectors.hpp"

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"

namespace dotyk::algebra {
namespace {

/// Room for one more column than `count`, twice as much where there is none left. Throws InputError where memory does not suffice.
void grow(DenseMatrix& columns, Eigen::Index rows, Eigen::Index count) {
  if (count < columns.cols()) return;
  const Eigen::Index room = std::max<Eigen::Index>(16, 2 * count);
  require_memory(8.0 * static_cast<double>(rows) * static_cast<double>(room), "the directions kept for further systems");
  columns.conservativeResize(rows, room);
}

}  // namespace

bool ConjugateBasis::conjugate(Vector& p) const {
  for (int twice = 0; twice < 2 && count_ > 0; ++twice) {
    const double before = p.norm();
    p -= directions() * (products().transpose() * p);
    if (p.norm() > before / 2) return true;
  }
  return count_ == 0;
}

Vector ConjugateBasis::solve(Vector& r) const {
  Vector x = Vector::Zero(r.size());
  for (int twice = 0; twice < 2 && count_ > 0; ++twice) {
    const Vector part = directions().transpose() * r;
    x += directions() * part;
    r -= products() * part;
  }
  return x;
}

void ConjugateBasis::add(const Vector& p, const Vector& w) {
  grow(p_, p.size(), count_);
  grow(w_, p.size(), count_);
  const double norm = std::sqrt(p.dot(w));
  p_.col(count_) = p / norm;
  w_.col(count_++) = w / norm;
}

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
