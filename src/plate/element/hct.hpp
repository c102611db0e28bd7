#pragma once

#include "plate/element/element.hpp"

namespace dotyk::plate {

/// Hsieh, Clough and Tocher's triangle by its Bernstein coefficients: third k has the corners (k, k + 1, centre). C¹ across the lines
/// from a vertex to the centre, which is that of mass, asks that a coefficient on such a line be the mean of the three about it nearer to the vertex.
class Hct final : public Basis {
 public:
  explicit Hct(const Triangle& triangle);
  int size() const override { return 12; }
  Shape at(const Barycentric& point) const override;
  Shape curvature_at(const Barycentric& point) const override;
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12> value_at(const Barycentric& point) const override;

 private:
  using Row = Eigen::Matrix<double, 1, 12>;
  void set_outer(const Triangle& t, int k);
  void set_middle(const Triangle& t, int k);
  void set_inner();
  /// Of a coefficient by its exponents: by the third, then the second one.
  static constexpr int place(int, int j, int l) { return (l * (9 - l)) / 2 + j; }
  /// By the three corners that it is between.
  static constexpr int between(int p, int q, int r) { return place(0, (p == 1) + (q == 1) + (r == 1), (p == 2) + (q == 2) + (r == 2)); }
  Row& c(int third, int i, int j, int l) { return coefficients_[third][place(i, j, l)]; }
  /// The third that a point lies in, and its barycentric coordinates there.
  static int third_of(const Barycentric& point, Barycentric& within);
  std::array<Row, 3> linear(int third, const Barycentric& within) const;
  Eigen::Matrix<double, 3, 12> curvature(int third, const Barycentric& within) const;

  std::array<std::array<Row, 10>, 3> coefficients_;
  std::array<Eigen::Matrix<double, 2, 3>, 3> gradient_;  ///< of the barycentric coordinates of a third
};

}  // namespace dotyk::plate
