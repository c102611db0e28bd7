#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// The parts of a problem that have nothing to do with one another: blocks that rows join, directly or through others, are one part. What is
/// small beside the forces or displacements of one part may be all there is in another: scales are a part's own.
struct Parts {
  int count = 0;
  std::vector<int> of_block, of_row;  ///< part of each block and row

  /// The greatest |v_r| of each part's rows; 0 of a part without rows.
  std::vector<double> greatest(const algebra::Vector& v) const;
};
Parts parts(const Problem& problem);

/// The least scale of each part that nothing loads, by a number of each (its greatest force or displacement, its work): so much of the greatest of the
/// others. Mostly its solution is zero, and what methods that treat all parts at once leave there by rounding must be below their tolerances
/// relative to this scale. Where no part is loaded, the greatest itself: all forces may vanish then.
std::vector<double> least_beside_others(const std::vector<double>& of_part, bool loaded);

}  // namespace dotyk::problem
