#include "plate/element/hct.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

Hct::Hct(const Triangle& t) {
  for (int k = 0; k < 3; ++k) {
    // λ of third k: b = (λk − λl, λk+1 − λl, 3λl), l the vertex off it.
    const int j = (k + 1) % 3, l = (k + 2) % 3;
    gradient_[k].col(0) = t.barycentric_gradient.col(k) - t.barycentric_gradient.col(l);
    gradient_[k].col(1) = t.barycentric_gradient.col(j) - t.barycentric_gradient.col(l);
    gradient_[k].col(2) = 3 * t.barycentric_gradient.col(l);
    set_outer(t, k);
    set_middle(t, k);
  }
  set_inner();
}

/// What values and gradients of the two vertices give: those of the edge, and of the lines to the centre next to the vertices.
void Hct::set_outer(const Triangle& t, int k) {
  const int j = (k + 1) % 3;
  const Vector2d centre = (t.x[0] + t.x[1] + t.x[2]) / 3;
  const auto next = [&](int vertex, const Vector2d& towards) {
    Row row = Row::Zero();
    row[3 * vertex] = 1;
    row.segment<2>(3 * vertex + 1) = (towards - t.x[vertex]).transpose() / 3;
    return row;
  };
  c(k, 3, 0, 0) = Row::Unit(3 * k);
  c(k, 0, 3, 0) = Row::Unit(3 * j);
  c(k, 2, 1, 0) = next(k, t.x[j]);
  c(k, 1, 2, 0) = next(j, t.x[k]);
  c(k, 2, 0, 1) = next(k, centre);
  c(k, 0, 2, 1) = next(j, centre);
}

/// The one amid a third, by the normal slope at the middle of its edge: with d the normal's barycentric components,
/// ∂n u = 3 Σ B²(½, ½, 0) Σ dp c there.
void Hct::set_middle(const Triangle& t, int k) {
  const Eigen::Vector3d d = gradient_[k].transpose() * t.normal[k];
  const Row slope = Row::Unit(9 + k) * t.sign[k];
  const Row known = 0.25 * (d[0] * c(k, 3, 0, 0) + d[1] * c(k, 2, 1, 0) + d[2] * c(k, 2, 0, 1)) + 0.5 * (d[0] * c(k, 2, 1, 0) + d[1] * c(k, 1, 2, 0)) +
                    0.25 * (d[0] * c(k, 1, 2, 0) + d[1] * c(k, 0, 3, 0) + d[2] * c(k, 0, 2, 1));
  c(k, 1, 1, 1) = (slope / 3 - known) * (2 / d[2]);
}

void Hct::set_inner() {
  std::array<Row, 3> second;
  for (int k = 0; k < 3; ++k) second[k] = (c(k, 2, 0, 1) + c(k, 1, 1, 1) + c((k + 2) % 3, 1, 1, 1)) / 3;
  const Row centre = (second[0] + second[1] + second[2]) / 3;
  for (int k = 0; k < 3; ++k) {
    c(k, 1, 0, 2) = second[k];
    c(k, 0, 1, 2) = second[(k + 1) % 3];
    c(k, 0, 0, 3) = centre;
  }
}

int Hct::third_of(const Barycentric& p, Barycentric& within) {
  int l;
  p.minCoeff(&l);
  const int k = (l + 1) % 3;
  within = {p[k] - p[l], p[(l + 2) % 3] - p[l], 3 * p[l]};
  return k;
}

/// Linear in a third: 6 Σ c(e + ep + eq) ∇bp ∇bqᵀ at the corner e.
Eigen::Matrix<double, 3, 12> Hct::curvature(int k, const Barycentric& within) const {
  Eigen::Matrix<double, 3, 12> out = Eigen::Matrix<double, 3, 12>::Zero();
  const auto& g = gradient_[k];
  const auto& c = coefficients_[k];
  for (int p = 0; p < 3; ++p)
    for (int q = p; q < 3; ++q) {
      const Row second = within[0] * c[between(0, p, q)] + within[1] * c[between(1, p, q)] + within[2] * c[between(2, p, q)];
      const double factor = p == q ? 6 : 12;
      out.row(0) += factor * g(0, p) * g(0, q) * second;
      out.row(1) += factor * g(1, p) * g(1, q) * second;
      out.row(2) += factor * (g(0, p) * g(1, q) + g(1, p) * g(0, q)) * second;
    }
  return out;
}

Shape Hct::curvature_at(const Barycentric& point) const {
  Barycentric b;
  const int k = third_of(point, b);
  Shape out;
  out.curvature = curvature(k, b);
  return out;
}

/// Two of de Casteljau's steps leave a linear polynomial.
std::array<Hct::Row, 3> Hct::linear(int k, const Barycentric& b) const {
  std::array<Row, 3> left;
  const auto& c = coefficients_[k];
  for (int r = 0; r < 3; ++r) {
    left[r] = b[0] * b[0] * c[between(0, 0, r)] + b[1] * b[1] * c[between(1, 1, r)] + b[2] * b[2] * c[between(2, 2, r)];
    left[r] += 2 * (b[0] * b[1] * c[between(0, 1, r)] + b[0] * b[2] * c[between(0, 2, r)] + b[1] * b[2] * c[between(1, 2, r)]);
  }
  return left;
}

Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12> Hct::value_at(const Barycentric& point) const {
  Barycentric b;
  const int k = third_of(point, b);
  const auto left = linear(k, b);
  return b[0] * left[0] + b[1] * left[1] + b[2] * left[2];
}

Shape Hct::at(const Barycentric& point) const {
  Barycentric b;
  const int k = third_of(point, b);
  Shape out;
  out.curvature = curvature(k, b);
  const auto left = linear(k, b);
  out.value = b[0] * left[0] + b[1] * left[1] + b[2] * left[2];
  out.gradient = Eigen::Matrix<double, 2, 12>::Zero();
  for (int r = 0; r < 3; ++r) out.gradient += 3 * gradient_[k].col(r) * left[r];
  return out;
}

}  // namespace dotyk::plate
