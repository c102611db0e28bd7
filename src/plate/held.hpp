#pragma once

#include <map>

#include "plate/samples.hpp"

namespace dotyk::plate {

/// The freedoms that prescribed laws hold: they are no unknowns.
struct Held {
  std::vector<char> is;    ///< one a freedom
  algebra::Vector value;   ///< 0 where free
  std::map<int, Eigen::Matrix2d> directions;  ///< HCT: Σ ddᵀ over the directions d that laws hold a vertex's gradient in
};

/// Holds what the prescribed ones of the samples say, and marks these `held`: u of a vertex (HCT: and the slope along the edge, at a
/// smooth vertex along the curve's tangent, at a corner along both edges), ∂ₙu. Turns the frames of the space's vertices so that
/// what is held is a freedom. Throws InputError where two laws contradict each other.
Held hold(const Plate& plate, Space& space, std::vector<Sample>& deflections, std::vector<Sample>& rotations);

/// A functional on the freedoms that are not held, and what the held ones add.
struct Reduced {
  Functional on_free;
  double held = 0;
};
Reduced reduce(const Functional& functional, const Held& held);

}  // namespace dotyk::plate
