#pragma once

#include "problem/problem.hpp"

namespace dotyk::problem {

/// How far a state is from optimal; each number is relative and its scale named.
struct Residual {
  double equilibrium = 0;      ///< ‖Ku + Bᵀλ − f‖ / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖); where f = 0, / √ε ‖|K||u|‖ if that is more
  double penetration = 0;      ///< greatest (Bu − c)⁺ over unilateral rows / greatest of all |Bu|, |u|, the row's |c|,
                               ///< and a millionth of what the multipliers would move a row by
  double complementarity = 0;  ///< Σ|λ (Bu − c)| over unilateral rows / (|energy| + Σ|λ c| + that movement's work);
                               ///< where f = 0, + √ε |u|ᵀ|K||u|
  double law = 0;              ///< ‖λ − P(λ + ρx)‖ / ‖λ‖, all rows, ρ the row stiffness
  double friction = 0;         ///< greatest violation of a friction bound / that bound
};

Residual residual(const Problem& problem, const State& state);

/// The equilibrium residual told apart from the rounding of motions as a whole. A block that is free but for its rows
/// moves by w = the part of u in its kernel, R; Kw = 0, but of a w that is rounded, to Kw about ε|K||w|, however small the
/// forces are: where the block is C times as stiff as what carries it, ε C of them. Such a residual says nothing
/// against u and λ. It is granted to a block up to 4ε‖|K||w|‖, and its resultants are asked for instead, which no rounding
/// of w enters as RᵀK = 0: Rᵀ(Bᵀλ − f) = 0. Where f = 0, forces below √ε‖|K||u|‖ are no scale here either.
struct MotionResidual {
  double beyond = 0;      ///< √Σ (‖Ku + Bᵀλ − f‖ − 4ε‖|K||w|‖)⁺², norms of each block / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖) of all
  /// Greatest |rᵀ(Bᵀλ − f)| / (max|r| Σ(|Bᵀ||λ| + |f|)) of all columns r of all R, sums over its block.
  double resultants = 0;
  int most = -1;          ///< the block with the greatest residual that is granted; -1: none
};
MotionResidual motion_residual(const Problem& problem, const State& state);

/// ½uᵀKu − fᵀu + offsets + the energies of the laws at Bu − c.
double energy(const Problem& problem, const State& state);

/// Σ b ‖x_t‖ over the friction points: the friction term of the energy (for Coulomb at the
/// solution's own normal multipliers).
double friction_energy(const Problem& problem, const State& state);

/// ‖λ − P(λ + ρx)‖ / ‖λ‖ (the numerator alone where λ = 0), the natural residual.
double natural_residual(const Problem& problem, const algebra::Vector& x,
                        const algebra::Vector& lambda, const algebra::Vector& rho);

}  // namespace dotyk::problem
