#pragma once

#include <memory>
#include <string>

#include "shape/design/design_state.hpp"

namespace dotyk::shape {

/// A number that a design has, and its exact gradient by the design variables; at a kink one-sided derivatives along growing variables.
class Quantity {
 public:
  virtual ~Quantity() = default;
  virtual std::string name() const = 0;
  virtual double value(const DesignState& state) const = 0;
  virtual algebra::Vector gradient(const DesignState& state) const = 0;
};

/// −min J = fᵀu − ½uᵀKu − Σφ, force × length: the compliance of P7 (18), with the energy of springs and of given friction.
/// Its gradient needs no linear solve (the envelope theorem): −∂J(u, λ; α)/∂α at fixed u and λ, also at kinks of u.
/// Throws InputError with Coulomb's friction, which has no energy.
std::shared_ptr<const Quantity> compliance();

/// Of all bodies; area in the plane.
double volume_of(const scene::Scene& scene);
std::shared_ptr<const Quantity> volume();

/// (∫ p^q ds / |Γ|)^{1/q} over the contacts' nodes, p the pressure there (force over ∫φ) where it is positive, |Γ| the length or area of the first
/// design's nodes in contact or able to be. It tends to the peak as q grows, and is at most the peak while contacts do not get longer. 0 where
/// nothing touches. Throws InputError without contacts, or with p1_p0 multipliers. `exponent` q ≥ 1.
std::shared_ptr<const Quantity> peak_pressure(double exponent);

}  // namespace dotyk::shape
