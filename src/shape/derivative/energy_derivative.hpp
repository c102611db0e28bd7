#pragma once

#include "scene/result/solution.hpp"
#include "shape/derivative/velocities.hpp"

namespace dotyk::shape {

/// d/dt of a solution's energy() + friction_energy() when nodes move: the energy of the state is least, so u' and λ' do not
/// enter (the envelope theorem), and no system is solved:
///   ½uᵀK'u − f'ᵀu − λᵀ(c' − B'u) + Σ_p g'_p ‖x_t‖,
/// u with prescribed displacements. Linear in V also where contact is weak. The compliance of P7 (18), uᵀf − ½uᵀKu, is
/// minus this energy where there are no springs in rows, friction or prescribed displacements.
/// Throws InputError as require_solution() and Sensitivity::change(), and for Coulomb friction, whose state is of least energy for no energy.
double energy_derivative(const scene::Solution& solution, const Velocities& velocities);

}  // namespace dotyk::shape
