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

  /// The greatest |v_r| of each part's rows, and ‖v‖₂ over them; 0 of a part without rows.
  std::vector<double> greatest(const algebra::Vector& v) const;
  std::vector<double> norm(const algebra::Vector& v) const;
};
/// One part where unknowns are hidden: sums over them are known of all blocks together.
Parts parts(const Problem& problem);

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

/// Adds a vector to a norm.
void add(double& norm, const Eigen::Ref<const algebra::Vector>& v);

}  // namespace dotyk::problem
