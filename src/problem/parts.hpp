#pragma once

#include <memory>
#include <optional>
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
/// One part where unknowns are hidden: sums over them are known of all blocks together.
Parts parts(const Problem& problem);

/// The least scale of each part that nothing loads, by a number of each (its greatest force or displacement, its work): so much of the greatest of the
/// others. Mostly its solution is zero, and what methods that treat all parts at once leave there by rounding must be below their tolerances
/// relative to this scale. Where no part is loaded, the greatest itself: all forces may vanish then.
std::vector<double> least_beside_others(const std::vector<double>& of_part, bool loaded);

/// The displacement of a state and its forces. Fields lie with the slices of K; without slices, in this process.
struct Forces {
  std::shared_ptr<const algebra::Field> u;
  std::optional<algebra::Field> internal;  ///< Ku; none where a pass over K is not worth it
  std::optional<algebra::Field> load;      ///< f, beside Ku; none where there are no loads
  std::vector<int> unknowns;               ///< those of rows, ascending
  algebra::Vector contact;                 ///< Bᵀλ at these
};

Forces external_forces(const Problem& problem, const State& state);  ///< without Ku and f
Forces forces(const Problem& problem, const State& state);

/// Sums over the unknowns of each part.
class OfParts {
 public:
  OfParts(const Problem& problem, const Parts& parts) : problem_(problem), parts_(parts) {}
  std::vector<double> dot(const algebra::Field& a, const algebra::Field& b) const;
  std::vector<double> norm(const algebra::Field& v) const;      ///< ‖v‖₂
  std::vector<double> greatest(const algebra::Field& v) const;  ///< ‖v‖∞

 private:
  template <class OfAll, class OfBlock>
  std::vector<double> each(const OfAll& of_all, const OfBlock& of_block) const;

  const Problem& problem_;
  const Parts& parts_;
};

/// What one part is measured by.
struct Sizes {
  double internal = 0, contact = 0, load = 0;  ///< ‖Ku‖ (0 where it is not at hand), ‖Bᵀλ‖, ‖f‖
  double greatest_load = 0, greatest_displacement = 0;
  /// Where nothing loads the part, the least that counts as a force, a displacement and work: what half of the digits of K|u| are, and
  /// least_beside_others(). Bodies that get out of an obstacle's way end free of forces, and rounding of K times their motion is all that is
  /// left of those.
  double least_force = 0, least_length = 0, least_work = 0;
  double force() const { return std::max(internal + contact + load, least_force); }
  double external() const { return std::max(contact + load, least_force); }
};

bool any_loaded(const std::vector<Sizes>& parts);
/// By part.
std::vector<Sizes> sizes(const Problem& problem, const State& state, const Forces& all, const Parts& parts);

/// Adds a vector to a norm.
void add(double& norm, const Eigen::Ref<const algebra::Vector>& v);

}  // namespace dotyk::problem
