#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::problem {

/// A friction law on points with one (2-D) or two (3-D) tangential rows: ‖λ_t‖ ≤ b with
/// λ_t = b x_t/‖x_t‖ where the slip x_t is not zero, φ(x_t) = b ‖x_t‖. The bound b, a force, may
/// depend on the normal multiplier of the same node.
class Friction {
 public:
  virtual ~Friction() = default;
  virtual std::string name() const = 0;
  /// b for the normal multiplier λ_n (taken as 0 where it pulls).
  virtual double bound(int point, double normal) const = 0;
  /// ∂b/∂λ_n for λ_n > 0.
  virtual double bound_slope(int point) const = 0;
  /// Does the bound follow the normal force? Then the problem is that of no energy.
  bool follows(int point) const { return bound_slope(point) > 0; }
};

/// Given friction (Tresca): b = g, a force for each point (bound per area times the point's share).
/// Throws InputError unless each is finite and not negative.
std::shared_ptr<const Friction> tresca(std::vector<double> bounds);

/// Coulomb: b = μ λ_n. Throws InputError unless each μ is finite and not negative.
std::shared_ptr<const Friction> coulomb(std::vector<double> coefficients);

/// The factor of the projection onto the disc of radius b: π_b(y) = disc_factor(‖y‖, b) y.
inline double disc_factor(double length, double bound) { return length <= bound ? 1 : bound / length; }

/// The projection onto the disc of radius b, λ = π_b(y), and its derivatives.
struct DiscProjection {
  Eigen::VectorXd value;    ///< components
  Eigen::MatrixXd slope;    ///< ∂π/∂y
  Eigen::VectorXd by_bound; ///< ∂π/∂b
  bool stick;               ///< ‖y‖ ≤ b
};
DiscProjection project_disc(const Eigen::Ref<const Eigen::VectorXd>& y, double bound);

/// Points of one friction law. Point k has rows first + k components … of B, and the normal row of
/// the same node; none (-1) is needed where the bound is given.
struct FrictionGroup {
  std::string name;
  std::shared_ptr<const Friction> law;
  int first = 0;
  int components = 1;
  std::vector<int> normal;  ///< normal row of each point, or -1
  int points() const { return static_cast<int>(normal.size()); }
  int row(int point) const { return first + point * components; }
  /// The row that lends the point its ρ: its normal row, else the first of its own.
  int scale_row(int point) const { return normal[point] < 0 ? row(point) : normal[point]; }
  /// b at these multipliers of all rows.
  double bound(int point, const algebra::Vector& lambda) const {
    return law->bound(point, normal[point] < 0 ? 0 : lambda[normal[point]]);
  }
};

}  // namespace dotyk::problem
