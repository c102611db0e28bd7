#pragma once

#include <functional>
#include <vector>

#include "thermoelastic/effect.hpp"

namespace dotyk::thermoelastic {

/// The elements of ϑ₁ and ϑ₂: cubic Hermite functions, unknowns (ϑ, ℓϑ') node by node. A cell's begin at twice its number.
class HeatElements {
 public:
  explicit HeatElements(std::vector<double> nodes);
  const std::vector<double>& nodes() const { return nodes_; }
  int cells() const { return static_cast<int>(nodes_.size()) - 1; }
  int unknowns() const { return 2 * static_cast<int>(nodes_.size()); }
  double h(int cell) const { return nodes_[cell + 1] - nodes_[cell]; }

  /// ∫ ηη and ∫ DηDη on a cell.
  Eigen::Matrix4d mass(int cell) const;
  Eigen::Matrix4d conduction(int cell) const;
  /// The part of a cell's functions among the polynomials of degree 1: its coefficients, as OnCells.
  const Eigen::Matrix<double, 2, 4>& projection(int cell) const { return projection_[cell]; }

  /// ∫ r η for all η.
  algebra::Vector load(const std::function<double(double)>& r) const;
  /// ∫ Σ η for Σ on cells, and ϑ's part among the polynomials of degree 1.
  algebra::Vector product(const OnCells& on_cells) const;
  OnCells projected(const algebra::Vector& theta) const;

 private:
  Eigen::Vector4d scale() const { return {1, 1 / nodes_.back(), 1, 1 / nodes_.back()}; }
  std::vector<double> nodes_;
  std::vector<Eigen::Matrix<double, 2, 4>> projection_;
};

}  // namespace dotyk::thermoelastic
