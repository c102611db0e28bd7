#include "plate/element/morley.hpp"

namespace dotyk::plate {

Morley::Morley(const Triangle& t) : t_(t) {
  curvature_.setZero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d n = t.normal[k], s = t.tangent[k];
    const Eigen::Vector3d of_normal(n[0] * n[0], n[1] * n[1], 2 * n[0] * n[1]);
    const Eigen::Vector3d of_tangent(s[0] * n[0], s[1] * n[1], s[0] * n[1] + s[1] * n[0]);
    curvature_.col(3 + k) = of_normal * (t.length[k] * t.sign[k] / t.area);
    curvature_.col((k + 1) % 3) += of_tangent / t.area;
    curvature_.col(k) -= of_tangent / t.area;
  }
}

Shape Morley::curvature_at(const Barycentric&) const {
  Shape out;
  out.curvature = curvature_;
  return out;
}

Shape Morley::at(const Barycentric& b) const {
  Shape out;
  out.curvature = curvature_;
  out.value = Eigen::Matrix<double, 1, 6>::Zero();
  out.gradient = Eigen::Matrix<double, 2, 6>::Zero();
  out.value.head<3>() = b.transpose();
  out.gradient.leftCols<3>() = t_.barycentric_gradient;
  for (int k = 0; k < 3; ++k) {
    const int j = (k + 1) % 3;
    const Eigen::Vector2d s = t_.tangent[k];
    const Eigen::Matrix<double, 1, 6> bend =
        0.5 * t_.length[k] * t_.length[k] * (Eigen::RowVector3d(s[0] * s[0], s[1] * s[1], s[0] * s[1]) * curvature_);
    out.value -= b[k] * b[j] * bend;
    out.gradient -= (b[k] * t_.barycentric_gradient.col(j) + b[j] * t_.barycentric_gradient.col(k)) * bend;
  }
  return out;
}

}  // namespace dotyk::plate
