#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// Keeps the rigid motions of free bodies held by the active rows.
class Holder {
 public:
  explicit Holder(const problem::Problem& problem);

  /// Adds rows to `active` until the active rows hold every rigid motion of every block: while a
  /// motion is free, the bodies move along the load's part of it until further unilateral rows close.
  /// `x` = Bu − c says where the rows are. Returns how many were added.
  /// Throws InputError where nothing would ever stop the motion, or no load drives it.
  int hold(std::vector<char>& active, const algebra::Vector& x) const;

 private:
  std::string motion_text(const algebra::Vector& motion) const;

  const problem::Problem& problem_;
  algebra::DenseMatrix N_;  ///< B R, rows × modes
  algebra::Vector e_;       ///< Rᵀ f
  std::vector<std::string> names_;
  std::vector<char> unilateral_;
};

}  // namespace dotyk::solver
