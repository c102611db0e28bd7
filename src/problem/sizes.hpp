#pragma once

#include <algorithm>
#include <vector>

#include "problem/parts.hpp"
#include "problem/problem.hpp"

namespace dotyk::problem {

/// Ku (empty where a pass over K is not worth it), Bᵀλ and f of all blocks.
struct Forces {
  algebra::Vector internal, contact, load;
};

Forces external_forces(const Problem& problem, const State& state);  ///< without Ku
Forces forces(const Problem& problem, const State& state);

/// |K||w|.
algebra::Vector gross_forces(const Block& block, const algebra::Vector& w);

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
