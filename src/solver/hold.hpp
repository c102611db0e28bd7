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
  /// until further unilateral rows close. `x` = Bu − c says where the rows are. Returns how many
  /// were added. Throws InputError where nothing would ever stop the motion.
  int hold(std::vector<char>& active, const algebra::Vector& x) const;

 private:
  /// Along `motion`, how far each row not active has to go: the least distance, infinite if none.
  double distance(const algebra::Vector& approach, const std::vector<char>& active,
                  const algebra::Vector& x) const;

  const problem::Problem& problem_;
  const problem::RigidMotions& rigid_;
  algebra::DenseMatrix N_;  ///< rows × noticed motions
  algebra::Vector e_;
  std::vector<char> unilateral_;
};

}  // namespace dotyk::solver
