#pragma once

#include "shape/design/design_state.hpp"

namespace dotyk::shape {

/// A node in contact as a design has it, and derivatives of that; of nodes without a row of B only place and weight change.
struct ContactValue {
  double force = 0, gap = 0, weight = 0;  ///< force: the normal multiplier; gap after deformation; weight ∫φ
  double pressure() const { return weight > 0 ? force / weight : 0; }
};

/// At each row of a contact; with `derivative`, their derivatives along V (the variable's velocities), else values.
std::vector<ContactValue> contact_values(const scene::Solution& solution, int contact);
std::vector<ContactValue> contact_derivatives(const scene::Solution& solution, int contact, const Velocities& V, const Derivative& derivative);

}  // namespace dotyk::shape
