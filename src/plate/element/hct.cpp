#include "plate/element/element.hpp"

namespace dotyk::plate {
namespace {

using Eigen::Vector2d;

/// Hsieh, Clough and Tocher's triangle by its Bernstein coefficients: third k has the corners (k, k + 1, centre). C¹ across the lines
/// from a vertex to the centre, which is that of mass, asks that a coefficient on such a line be the mean of the three about it nearer to the vertex.
class Hct final : public Basis {
 public:
  explicit Hct(const Triangle& t) {
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

  int size() const override { return 12; }

  Values value(const Barycentric& point) const override {
    Barycentric b;
    const auto left = linear(third_of(point, b), b);
    return b[0] * left[0] + b[1] * left[1] + b[2] * left[2];
  }

  Gradients gradient(const Barycentric& point) const override {
    Barycentric b;
    const int k = third_of(point, b);
    const auto left = linear(k, b);
    Gradients out = Gradients::Zero(2, 12);
    for (int r = 0; r < 3; ++r) out += 3 * gradient_[k].col(r) * left[r];
    return out;
  }

  /// Linear in a third: 6 Σ c(e + ep + eq) ∇bp ∇bqᵀ at the corner e.
  Curvatures curvature(const Barycentric& point) const override {
    Barycentric within;
    const int k = third_of(point, within);
    Curvatures out = Curvatures::Zero(3, 12);
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

 private:
  using Row = Eigen::Matrix<double, 1, 12>;

  /// What values and gradients of the two vertices give: those of the edge, and of the lines to the centre next to the vertices.
  void set_outer(const Triangle& t, int k) {
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
  void set_middle(const Triangle& t, int k) {
    const Eigen::Vector3d d = gradient_[k].transpose() * t.normal[k];
    const Row slope = Row::Unit(9 + k) * t.sign[k];
    const Row known = 0.25 * (d[0] * c(k, 3, 0, 0) + d[1] * c(k, 2, 1, 0) + d[2] * c(k, 2, 0, 1)) + 0.5 * (d[0] * c(k, 2, 1, 0) + d[1] * c(k, 1, 2, 0)) +
                      0.25 * (d[0] * c(k, 1, 2, 0) + d[1] * c(k, 0, 3, 0) + d[2] * c(k, 0, 2, 1));
    c(k, 1, 1, 1) = (slope / 3 - known) * (2 / d[2]);
  }

  void set_inner() {
    std::array<Row, 3> second;
    for (int k = 0; k < 3; ++k) second[k] = (c(k, 2, 0, 1) + c(k, 1, 1, 1) + c((k + 2) % 3, 1, 1, 1)) / 3;
    const Row centre = (second[0] + second[1] + second[2]) / 3;
    for (int k = 0; k < 3; ++k) {
      c(k, 1, 0, 2) = second[k];
      c(k, 0, 1, 2) = second[(k + 1) % 3];
      c(k, 0, 0, 3) = centre;
    }
  }

  /// Of a coefficient by its exponents: by the third, then the second one.
  static constexpr int place(int, int j, int l) { return (l * (9 - l)) / 2 + j; }
  /// By the three corners that it is between.
  static constexpr int between(int p, int q, int r) { return place(0, (p == 1) + (q == 1) + (r == 1), (p == 2) + (q == 2) + (r == 2)); }
  Row& c(int third, int i, int j, int l) { return coefficients_[third][place(i, j, l)]; }

  /// The third that a point lies in, and its barycentric coordinates there.
  static int third_of(const Barycentric& p, Barycentric& within) {
    int l;
    p.minCoeff(&l);
    const int k = (l + 1) % 3;
    within = {p[k] - p[l], p[(l + 2) % 3] - p[l], 3 * p[l]};
    return k;
  }

  /// Two of de Casteljau's steps leave a linear polynomial.
  std::array<Row, 3> linear(int k, const Barycentric& b) const {
    std::array<Row, 3> left;
    const auto& c = coefficients_[k];
    for (int r = 0; r < 3; ++r) {
      left[r] = b[0] * b[0] * c[between(0, 0, r)] + b[1] * b[1] * c[between(1, 1, r)] + b[2] * b[2] * c[between(2, 2, r)];
      left[r] += 2 * (b[0] * b[1] * c[between(0, 1, r)] + b[0] * b[2] * c[between(0, 2, r)] + b[1] * b[2] * c[between(1, 2, r)]);
    }
    return left;
  }

  std::array<std::array<Row, 10>, 3> coefficients_;
  std::array<Eigen::Matrix<double, 2, 3>, 3> gradient_;  ///< of the barycentric coordinates of a third
};

}  // namespace

std::unique_ptr<const Basis> hct(const Triangle& triangle) { return std::make_unique<Hct>(triangle); }

}  // namespace dotyk::plate
