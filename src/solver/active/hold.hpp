#pragma once

#include <vector>

#include "problem/rigid_motions.hpp"

namespace dotyk::solver {

/// Keeps the rigid motions of free bodies held by the active rows.
class Holder {
 public:
  Holder(const problem::Problem& problem, const problem::RigidMotions& rigid);

  /// Adds rows to `active` until the active rows hold every motion that rows notice: while one is
  /// free, the bodies move along the load's part of it (or, without one, towards the nearest row)
  /// until further rows close. `x` = Bu − c says where the rows are, λ what those bear that are not active: the least
  /// or the greatest that their law allows. Returns how many were added. Throws InputError where nothing would ever
  /// stop the motion.
  int hold(std::vector<char>& active, const algebra::Vector& x, const algebra::Vector& lambda) const;

 private:
  /// Where the rows are, and what those bear that are not active.
  struct Rows {
    const std::vector<char>& active;
    const algebra::Vector &x, &lambda;
  };
  /// How far a row, moving by `approach` per unit, has to go until its λ follows x; infinite where it is, or never does.
  double distance(int row, double approach, const Rows& at) const;
  /// The least of all rows.
  double distance(const algebra::Vector& approach, const Rows& at) const;

  const problem::Problem& problem_;
  const problem::RigidMotions& rigid_;
  algebra::SparseRows N_;  ///< rows × noticed motions
  algebra::Vector e_;
  std::vector<problem::Interval> following_, multipliers_;  ///< of every row's law
};

}  // namespace dotyk::solver
