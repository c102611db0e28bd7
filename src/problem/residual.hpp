#pragma once

#include <algorithm>

#include "problem/measure.hpp"

namespace dotyk::problem {

/// How far a state is from optimal. All numbers are relative to the Measure of the state's problem, each part by its own F and X, and
/// each number is the greatest of all parts. A row is right where a change of its force by a small part of F, or of its gap by a small part
/// of X, puts it on its law's graph: up to a factor of √2 that is |λ − P(λ + ρx)|/F with ρ = F/X, whatever the units.
struct Residual {
  double equilibrium = 0;      ///< ‖Ku + Bᵀλ − f‖₂ / F
  double penetration = 0;      ///< greatest (Bu − c)⁺ / X of unilateral rows
  double complementarity = 0;  ///< Σ|λ| min(|Bu − c|, X) / FX over unilateral rows: beyond X a row is open, however far
  double law = 0;              ///< greatest |λ − P(λ + ρx)| / F of all rows and points of friction
  double friction = 0;         ///< greatest violation of a friction bound / F
  double energy = 0;           ///< the state's: see energy()
  /// How far the state is from its laws.
  double laws() const { return std::max({penetration, complementarity, law, friction}); }
};

Residual residual(const Problem& problem, const State& state);

/// Residual::laws() without a pass over K.
double distance_from_laws(const Problem& problem, const State& state);

/// The size of Residual::equilibrium that rounding alone explains, with one rounding error in each product of K u: ε‖|K||u|‖ / F.
double rounding_of_equilibrium(const Problem& problem, const State& state);

/// By row, the error of its force that one rounding error in each product of Ku may make: ε(|B||K||u|)_r / Σ_j B_rj². It is comparable to
/// the force where cells are so thin that their stiffness times the displacement is 1/ε of it. 0 for rows that are open by more than a
/// millionth of X.
algebra::Vector rounding_of_forces(const Problem& problem, const State& state);

/// "equilibrium 1e-16, penetration 0, complementarity 0, friction 0, law 2e-16".
std::string describe(const Residual& residual);

/// The equilibrium residual told apart from the rounding of motions as a whole. A block that is free but for its rows moves by w, the part of
/// u in its kernel R: Kw = 0, but of a rounded w about ε|K||w|, however small the forces are. Such a residual says nothing against u and λ: it is
/// granted up to 4ε‖|K||w|‖, and the resultants are asked for instead, Rᵀ(Bᵀλ − f) = 0, which no rounding of w enters as RᵀK = 0.
struct MotionResidual {
  double beyond = 0;      ///< √Σ (‖Ku + Bᵀλ − f‖ − 4ε‖|K||w|‖)⁺², norms of each block / F of the part
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

/// |λ − P(λ + ρx)| of each row, a force: the distance from its law, in the plane of λ and ρx; of a friction point at its first row.
/// `rounding`: by row, how far x may be off; the least distance counts then.
algebra::Vector distances_from_laws(const Problem& problem, const algebra::Vector& x, const algebra::Vector& lambda, const algebra::Vector& rho,
                                    const algebra::Vector& rounding = {});

/// The norm of all distances / ‖λ‖ (the numerator alone where λ = 0), the natural residual.
double natural_residual(const Problem& problem, const algebra::Vector& x,
                        const algebra::Vector& lambda, const algebra::Vector& rho);

}  // namespace dotyk::problem
