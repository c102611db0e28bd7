#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/lists.hpp"

namespace dotyk::elasticity {

/// How a plane body sees the third direction.
enum class Plane { strain, stress };

/// Hooke's tensor σ_ij = c_ijkl ε_kl with the usual symmetries, in force per
/// area; only indices below `dimension` are meant. In 2-D, per unit thickness.
struct Hooke {
  int dimension = 2;
  double c[3][3][3][3] = {};
  /// σ_zz = zz_factor (σ_xx + σ_yy) in the plane: ν in isotropic plane strain, else 0.
  double zz_factor = 0;
  bool isotropic = false;  ///< then c_ijkl = λ δ_ij δ_kl + μ (δ_ik δ_jl + δ_il δ_jk) with λ = c_xxyy, μ = c_xyxy
  bool operator==(const Hooke&) const = default;
};

/// Isotropic material with Lamé's parameters λ and μ. Its zz_factor is 0.
Hooke by_lame(double lambda, double mu, int dimension);
/// Isotropic material with Young's modulus E and Poisson's ratio nu.
Hooke isotropic(double E, double nu, int dimension, Plane plane);

/// Voigt's order of pairs: xx yy zz yz xz xy, and which of these a dimension has.
inline constexpr int kVoigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
inline std::vector<int> voigt_components(int dimension) { return dimension == 2 ? std::vector{0, 1, 5} : std::vector{0, 1, 2, 3, 4, 5}; }

/// From the Voigt matrix (3×3 in 2-D, order xx yy xy; 6×6 in 3-D, order
/// xx yy zz yz xz xy; engineering shear). Throws InputError unless it is
/// square of that size, symmetric and positive definite.
Hooke from_voigt(const algebra::DenseMatrix& voigt);

/// Throws InputError for E ≤ 0 or ν outside (-1, ½) (½ itself is incompressible;
/// in plane stress ½ is allowed).
void check_isotropic(double E, double nu, bool plane_stress);

/// The material of every cell of a body: one tensor, or isotropic values cell by cell.
class MaterialField {
 public:
  MaterialField() = default;
  explicit MaterialField(const Hooke& uniform) : uniform_(uniform) {}
  MaterialField(std::vector<double> E, std::vector<double> nu, int dimension, Plane plane)
      : E_(std::move(E)), nu_(std::move(nu)), dimension_(dimension), plane_(plane) {}

  /// The field as so many lists of numbers, and a field from the first ones of such lists.
  static constexpr int kWholeLists = 1, kRealLists = 3;
  Lists lists() const;
  explicit MaterialField(const Lists& lists);

  bool varies() const { return !E_.empty(); }
  Hooke at(int cell) const {
    return varies() ? isotropic(E_[cell], nu_[cell], dimension_, plane_) : uniform_;
  }
  /// c_xxxx of the first cell: the scale of stiffness in messages and tolerances.
  double scale() const { return at(0).c[0][0][0][0]; }
  /// The material of these cells, numbered as they come.
  MaterialField of(const std::vector<int>& cells) const;
  bool operator==(const MaterialField&) const = default;

 private:
  Hooke uniform_;
  std::vector<double> E_, nu_;
  int dimension_ = 2;
  Plane plane_ = Plane::strain;
};

}  // namespace dotyk::elasticity
