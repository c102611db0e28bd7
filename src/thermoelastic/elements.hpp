#pragma once

#include <functional>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::thermoelastic {

/// ε and its generalised stress on the cells as polynomials of degree 1: coefficients of the orthonormal Legendre
/// polynomials 1 and √3 (2s − 1), 2 × cells.
using OnCells = Eigen::Matrix<double, 2, Eigen::Dynamic>;
/// A cell's unknowns, at most four, and their strain.
using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using CellStrain = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 4>;

/// The quadratic functions of a cell's left end, middle and right end at 0 ≤ s ≤ 1.
Eigen::Vector3d quadratic(double s);

/// One of the two mechanical effects, with its strain ε(u) and stress S = C (ε − βϑ):
///   stretching: ε = Du₁, C = EF, β = α, S = N;    bending: ε = D²u₂, C = EJ, β = −α, S = −M.
/// Quadratic elements for u₁ (per node u, then the middle of the cell), cubic Hermite ones for u₂ (u, ℓu'): in both the
/// strains of all u are all polynomials of degree 1 on the cells, and a cell's unknowns begin at twice its number.
class Effect {
 public:
  enum class Kind { stretching, bending };
  /// C and β: of each cell.
  Effect(Kind kind, const std::vector<double>& nodes, algebra::Vector modulus, algebra::Vector beta);

  Kind kind() const { return kind_; }
  const algebra::Vector& modulus() const { return modulus_; }
  const algebra::Vector& beta() const { return beta_; }
  int cells() const { return static_cast<int>(nodes_.size()) - 1; }
  int unknowns() const { return 2 * cells() + cell_unknowns() - 2; }
  int cell_unknowns() const { return kind_ == Kind::bending ? 4 : 3; }
  double h(int cell) const { return nodes_[cell + 1] - nodes_[cell]; }

  /// ε's coefficients from a cell's unknowns: 2 × cell_unknowns().
  const CellStrain& strain_matrix(int cell) const { return strain_[cell]; }
  /// ∫ f v for a cell's shape functions v.
  CellVector cell_load(int cell, const std::function<double(double)>& f) const;
  /// The motions without strain: 1, and for bending x/ℓ − ½.
  algebra::DenseMatrix kernel() const;

  /// The stress that balances nodal forces f (their work on the kernel must be zero): from cell to cell by statics.
  OnCells stress(const algebra::Vector& f) const;
  /// The displacement with these strains that is zero, with its slope, at the left end.
  algebra::Vector displacement(const OnCells& strain) const;

 private:
  CellStrain cell_strain(int cell) const;
  Kind kind_;
  std::vector<double> nodes_;
  algebra::Vector modulus_, beta_;
  std::vector<CellStrain> strain_;
  std::vector<Eigen::Matrix2d> from_forces_;  ///< a cell's stress from the forces on its first two unknowns
  std::vector<Eigen::Matrix2d> from_strain_;  ///< its last two unknowns from its strain, the first ones zero
};

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
