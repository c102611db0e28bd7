#include "plate/free_motions.hpp"

#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

namespace dotyk::plate {

using algebra::DenseMatrix;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// a + b (x − x₀)/ℓ + c (y − y₀)/ℓ.
Motion motion(const Vector3d& p, const Vector2d& centre, double unit) {
  const Vector2d slope = p.tail<2>();
  if (slope.norm() < 1e-9 * std::abs(p[0])) return {Motion::Kind::translation, {0, 0, 1}};
  const Vector2d on_axis = centre - p[0] * unit / slope.squaredNorm() * slope;
  const Vector2d along = Vector2d(slope[1], -slope[0]).normalized();
  return {Motion::Kind::rotation, {along[0], along[1], 0}, {on_axis[0], on_axis[1], 0}};
}

}  // namespace

FreeMotions free_motions(const Space& space, const Held& held, const std::vector<int>& unknown) {
  const DenseMatrix R = space.motions();
  Eigen::Matrix3d stopped = Eigen::Matrix3d::Zero();
  int count = 0, unknowns = 0;
  for (int i = 0; i < R.rows(); ++i) {
    if (held.is[i]) stopped += R.row(i).transpose() * R.row(i), ++count;
    else ++unknowns;
  }
  // A motion that moves no held freedom by more than 1e-6 of what it moves others by.
  const algebra::Eigenpairs3 eigen = algebra::eigenpairs3(stopped);
  int free = 0;
  while (free < 3 && eigen.values[free] <= 1e-12 * std::max(count, 1)) ++free;
  const DenseMatrix coefficients = free == 3 ? DenseMatrix(DenseMatrix::Identity(3, 3)) : free > 0 ? algebra::pure(eigen.vectors.leftCols(free)) : DenseMatrix(3, 0);
  FreeMotions out;
  out.kernel.resize(unknowns, free);
  for (int i = 0; i < R.rows(); ++i)
    if (unknown[i] >= 0) out.kernel.row(unknown[i]) = R.row(i) * coefficients;
  for (int j = 0; j < free; ++j) out.motions.push_back(motion(coefficients.col(j), space.centre(), space.unit));
  return out;
}

}  // namespace dotyk::plate
