#pragma once

#include <array>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::solver {

/// Ω ⊂ Rⁿ, a product of intervals [low_i, high_i] (ends may be infinite) and of discs
/// ‖(x_i, x_j) − centre‖ ≤ radius, and what minimising a function of gradient g over Ω needs of it.
///
/// x_i is free where low_i < x_i < high_i, a pair where it lies strictly within its disc. A pair on its circle,
/// outward normal n, slides: it may move along the circle, whose curvature adds −nᵀg/radius to the Hessian
/// where −g pushes the pair outward. All other components are active. The projected gradient g^P, minus the
/// projection of −g onto the tangent cone of Ω at x, is zero exactly at the solution. It splits into φ + β
/// (Dostál 2009, ch. 5):
///   the free gradient    φ = g at free components, g − (nᵀg) n at sliding pairs, 0 at active components,
///   the chopped gradient β = max(nᵀg, 0) n at sliding pairs, g at active components where the step −g leads into
///                        Ω, else 0.
/// Dostál and Kozubek 2012 (MPGP) chop the gradient along circles, too, and leave it to fixed steps, which take κ
/// steps where conjugate gradients along the circles take √κ. An interval of one point and a disc of radius 0 are
/// fixed: active, β = 0.
class SeparableSet {
 public:
  struct Disc {
    int first, second;          ///< the components i ≠ j
    Eigen::Vector2d centre;
    double radius;              ///< ≥ 0, finite
    std::array<int, 2> both() const { return {first, second}; }
  };
  enum class Place : char { active, free, sliding };
  struct Gradients {
    algebra::Vector free, chopped;  ///< φ and β, n
    std::vector<Place> face;        ///< n
    algebra::Vector curvature;      ///< max(−nᵀg, 0)/radius at sliding pairs, else 0; empty where there are no discs
    bool slides = false;            ///< is there a sliding pair?
  };

  /// Throws InputError where sizes differ, low > high, a number is nan, or a component of a disc is out of
  /// range, shared, or has an interval as well (it must be (−∞, ∞)).
  SeparableSet(algebra::Vector low, algebra::Vector high, std::vector<Disc> discs = {});

  Eigen::Index size() const { return low_.size(); }
  bool has_discs() const { return !discs_.empty(); }
  const algebra::Vector& low() const { return low_; }
  const algebra::Vector& high() const { return high_; }
  const std::vector<Disc>& discs() const { return discs_; }

  /// The nearest point of Ω to x; contains() it exactly, rounding included.
  algebra::Vector project(algebra::Vector x) const;
  bool contains(const algebra::Vector& x) const;

  /// φ, β and the face of x ∈ Ω.
  Gradients gradients(const algebra::Vector& x, const algebra::Vector& g) const;
  /// v made a direction in the face of x: zero off it, without normal part at sliding pairs.
  algebra::Vector tangential(const algebra::Vector& x, const Gradients& gradients, algebra::Vector v) const;
  /// An orthonormal basis of the directions in the face of x: a unit vector for each free component, the circle's
  /// tangent for each sliding pair. n × their number.
  algebra::SparseMatrix directions(const algebra::Vector& x, const Gradients& gradients) const;
  /// φ̃ = (x − P(x − αφ))/α, the reduced free gradient for a step length α > 0.
  algebra::Vector reduced_free(const algebra::Vector& x, const algebra::Vector& free, double alpha) const;
  /// The longest step α_f ≥ 0 with x − α_f p ∈ Ω, where −p leads into Ω or along the face; infinite where nothing
  /// ends it. A sliding pair of tangential p turns by 45° at most.
  double longest_step(const algebra::Vector& x, const algebra::Vector& p) const;
  /// x − αp for 0 ≤ α ≤ α_f, sliding pairs put back onto their circles; a component that reaches an end up to
  /// rounding is put there, so that the step of length α_f leaves the face.
  algebra::Vector along(const algebra::Vector& x, const algebra::Vector& p, double alpha) const;
  /// inf wᵀy over y ∈ Ω; −∞ where |w_i| > 1e-10 ‖w‖ leads along a component without end.
  double infimum(const algebra::Vector& w) const;
  /// By how much gᵀx may differ between two points that are the same but for rounding on the circles.
  double rounding(const algebra::Vector& g) const;

 private:
  void classify(std::size_t disc, const algebra::Vector& x, const algebra::Vector& g, Gradients& out) const;
  Eigen::Vector2d offset(const Disc& disc, const algebra::Vector& x) const {
    return Eigen::Vector2d(x(disc.both())) - disc.centre;
  }

  algebra::Vector low_, high_;
  std::vector<Disc> discs_;
  std::vector<double> edge_;  ///< a point this far from the centre is on the circle, up to rounding
};

}  // namespace dotyk::solver
