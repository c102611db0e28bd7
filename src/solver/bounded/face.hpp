#pragma once

#include "problem/problem.hpp"

namespace dotyk::solver {

/// The face of the admissible multipliers, bounds b of friction given, that λ lies on, and what conjugate
/// gradients need of the dual energy q(λ) = ½λᵀWλ − x₀ᵀλ + Σφ*(λ) there. A scalar row strictly within its
/// interval is free (at a kink of φ* it has two, which end there), and so is a friction point strictly within its disc. A point on its circle that x
/// pushes outward is free along the circle, whose curvature adds x·n/b to the Hessian (n = λ_t/b); one that x
/// pushes inward, and a row at an end of its interval, are not free.
class Face {
 public:
  Face(const problem::Problem& problem, const algebra::Vector& lambda, const algebra::Vector& x,
       const algebra::Vector& rho, const algebra::Vector& bounds);

  /// −∇q along the face.
  const algebra::Vector& gradient() const { return gradient_; }
  const std::vector<char>& free() const { return free_; }
  /// v made tangential: zero off the free rows, without part along n on circles.
  algebra::Vector tangential(algebra::Vector v) const;
  /// What laws and circles add to W in the direction p: Σ(φ*'' or x·n/b) p².
  double curvature(const algebra::Vector& p) const { return p.cwiseAbs2().dot(added_); }
  /// How far from λ along p all stays admissible: a part of p, infinite where nothing ends it. A circle's
  /// point turns by no more than about 45°.
  double room(const algebra::Vector& p) const;
  /// λ + step p, points of circles put back onto them.
  algebra::Vector along(double step, const algebra::Vector& p) const;
  /// The same rows free as on another face of the problem.
  bool same(const Face& other) const { return free_ == other.free_; }

 private:
  struct Disc {
    int first, count;
    double bound;
    bool circle;  ///< on it
  };
  void add_rows(const algebra::Vector& x, const algebra::Vector& rho);
  void add_discs(const algebra::Vector& x, const algebra::Vector& bounds);

  const problem::Problem& problem_;
  algebra::Vector lambda_, gradient_, added_;
  std::vector<char> free_;    ///< 0 not, 1 free, 2 along a circle
  std::vector<Disc> discs_;  ///< the free ones
};

}  // namespace dotyk::solver
