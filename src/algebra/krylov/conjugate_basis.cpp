#include "algebra/krylov/conjugate_basis.hpp"

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"

namespace dotyk::algebra {

void grow(DenseMatrix& columns, Eigen::Index rows, Eigen::Index count) {
  if (count < columns.cols()) return;
  const Eigen::Index room = std::max<Eigen::Index>(16, 2 * count);
  require_memory(8.0 * static_cast<double>(rows) * static_cast<double>(room), "the directions kept for further systems");
  columns.conservativeResize(rows, room);
}

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

}  // namespace dotyk::algebra
