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

/// d/dt of a solution's energy() + friction_energy() when nodes move: the energy of the state is least, so u' and λ' do not
/// enter (the envelope theorem), and no system is solved:
///   ½uᵀK'u − f'ᵀu − λᵀ(c' − B'u) + Σ_p g'_p ‖x_t‖,
/// u with prescribed displacements. Linear in V also where contact is weak. The compliance of P7 (18), uᵀf − ½uᵀKu, is
/// minus this energy where there are no springs in rows, friction or prescribed displacements.
/// Throws InputError as require_solution() and Sensitivity::change(), and for Coulomb friction, whose state is of least energy for no energy.
double energy_derivative(const scene::Solution& solution, const Velocities& velocities);

/// −min J = fᵀu − ½uᵀKu − Σφ, force × length: the compliance of P7 (18), with the energy of springs and of given friction.
/// Its gradient needs no linear solve (the envelope theorem): −∂J(u, λ; α)/∂α at fixed u and λ, also at kinks of u.
/// Throws InputError with Coulomb's friction, which has no energy.
std::shared_ptr<const Quantity> compliance();

/// Of all bodies; area in the plane.
double volume_of(const scene::Scene& scene);
std::shared_ptr<const Quantity> volume();

/// A node in contact as a design has it, and derivatives of that; of nodes without a row of B only place and weight change.
struct ContactValue {
  double force = 0, gap = 0, weight = 0;  ///< force: the normal multiplier; gap after deformation; weight ∫φ
  double pressure() const { return weight > 0 ? force / weight : 0; }
};

/// At each row of a contact; with `derivative`, their derivatives along V (the variable's velocities), else values.
std::vector<ContactValue> contact_values(const scene::Solution& solution, int contact);
std::vector<ContactValue> contact_derivatives(const scene::Solution& solution, int contact, const Velocities& V, const Derivative& derivative);

/// (∫ p^q ds / |Γ|)^{1/q} over the contacts' nodes, p the pressure there (force over ∫φ) where it is positive, |Γ| the length or area of the first
/// design's nodes in contact or able to be. It tends to the peak as q grows, and is at most the peak while contacts do not get longer. 0 where
/// nothing touches. Throws InputError without contacts, or with p1_p0 multipliers. `exponent` q ≥ 1.
std::shared_ptr<const Quantity> peak_pressure(double exponent);

}  // namespace dotyk::shape
