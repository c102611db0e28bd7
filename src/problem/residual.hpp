#pragma once

#include "problem/problem.hpp"

namespace dotyk::problem {

/// How far a state is from optimal; each number is relative and its scale named.
struct Residual {
  double equilibrium = 0;      ///< ‖Ku + Bᵀλ − f‖ / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖)
  double penetration = 0;      ///< greatest (Bu − c)⁺ over unilateral rows / greatest of all |Bu|, |u|, the row's |c|,
                               ///< and a millionth of what the multipliers would move a row by
  double complementarity = 0;  ///< Σ|λ (Bu − c)| over unilateral rows / (|energy| + Σ|λ c| + that movement's work)
  double law = 0;              ///< ‖λ − P(λ + ρx)‖ / ‖λ‖, all rows, ρ the row stiffness
  double friction = 0;         ///< greatest violation of a friction bound / that bound
};

Residual residual(const Problem& problem, const State& state);

/// ½uᵀKu − fᵀu + offsets + the energies of the laws at Bu − c.
double energy(const Problem& problem, const State& state);

/// Σ b ‖x_t‖ over the friction points: the friction term of the energy (for Coulomb at the
/// solution's own normal multipliers).
double friction_energy(const Problem& problem, const State& state);

/// ‖λ − P(λ + ρx)‖ / ‖λ‖ (the numerator alone where λ = 0), the natural residual.
double natural_residual(const Problem& problem, const algebra::Vector& x,
                        const algebra::Vector& lambda, const algebra::Vector& rho);

}  // namespace dotyk::problem
