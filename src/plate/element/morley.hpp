#pragma once

#include "plate/element/element.hpp"

namespace dotyk::plate {

/// Morley 1968. ∫ ∂ij u over the cell is ∫ ∂i u nj over its boundary, where the freedoms give ∫ ∂n u and ∫ ∂t u of each edge; and
/// u = Σ λi ui − ½ Σ λk λk+1 lk² ∂tt u, edge k from vertex k to k + 1.
class Morley final : public Basis {
 public:
  explicit Morley(const Triangle& triangle);
  int size() const override { return 6; }
  Shape at(const Barycentric& point) const override;
  Shape curvature_at(const Barycentric& point) const override;

 private:
  const Triangle& t_;
  Eigen::Matrix<double, 3, 6> curvature_;
};

}  // namespace dotyk::plate
