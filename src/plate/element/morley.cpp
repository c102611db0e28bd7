#include "plate/element/element.hpp"

namespace dotyk::plate {
namespace {

/// Morley 1968. ∫ ∂ij u over the cell is ∫ ∂i u nj over its boundary, where the freedoms give ∫ ∂n u and ∫ ∂t u of each edge; and
/// u = Σ λi ui − ½ Σ λk λk+1 lk² ∂tt u, edge k from vertex k to k + 1.
class Morley final : public Basis {
 public:
  explicit Morley(const Triangle& t) : t_(t) {
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

  int size() const override { return 6; }
  Curvatures curvature(const Barycentric&) const override { return curvature_; }

  Values value(const Barycentric& b) const override {
    Values out = Values::Zero(6);
    out.head<3>() = b.transpose();
    for (int k = 0; k < 3; ++k) out -= b[k] * b[(k + 1) % 3] * bend(k);
    return out;
  }

  Gradients gradient(const Barycentric& b) const override {
    Gradients out = Gradients::Zero(2, 6);
    out.leftCols<3>() = t_.barycentric_gradient;
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3;
      out -= (b[k] * t_.barycentric_gradient.col(j) + b[j] * t_.barycentric_gradient.col(k)) * bend(k);
    }
    return out;
  }

 private:
  /// ½ lk² ∂tt u.
  Eigen::Matrix<double, 1, 6> bend(int k) const {
    const Eigen::Vector2d s = t_.tangent[k];
    return 0.5 * t_.length[k] * t_.length[k] * (Eigen::RowVector3d(s[0] * s[0], s[1] * s[1], s[0] * s[1]) * curvature_);
  }

  const Triangle& t_;
  Eigen::Matrix<double, 3, 6> curvature_;
};

}  // namespace

std::unique_ptr<const Basis> morley(const Triangle& triangle) { return std::make_unique<Morley>(triangle); }

}  // namespace dotyk::plate
