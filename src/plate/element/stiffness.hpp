#pragma once

#include "plate/held.hpp"

namespace dotyk::plate {

/// D at the points of every cell's stiffness_rule(): cells × points; of a constant those of one cell. Throws InputError where it is not positive.
std::vector<double> bending_stiffness(const Plate& plate);

struct Stiffness {
  algebra::SparseMatrix on_free;   ///< lower triangle, of the unknowns
  algebra::Vector force_of_held;   ///< K times the values of the held freedoms, on the unknowns
  double energy_of_held = 0;       ///< ½vᵀKv of them
};

/// ∫ D κᵀCκ of the mesh. `D`: as bending_stiffness() gives it; `unknown` of a freedom, −1: held.
Stiffness stiffness(const std::vector<double>& D, double nu, const Space& space, const Held& held, const std::vector<int>& unknown);

/// K u − load on the freedoms that are held, zero on others: what holds them. `u`: every freedom.
algebra::Vector holding_forces(const std::vector<double>& D, double nu, const Space& space, const Held& held, const algebra::Vector& load, const algebra::Vector& u);

}  // namespace dotyk::plate
