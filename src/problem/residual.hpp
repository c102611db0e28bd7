#pragma once

#include <algorithm>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// How far a state is from optimal; each number is relative and its scale named.
///
/// The forces of a problem, of each of its Parts for itself, are measured by F, the greatest of |λ|, |f| (where f = 0: of |λ| and √ε ‖|K||u|‖), its
/// displacements by X, the greatest of |Bu|, |u| and a tenth of what a force of max|λ| would move the stiffest row by; a row of
/// a gap c_r > X by |c_r|. A row is right where a change of its force by a small part of F, or of its gap by a small part
/// of X, puts it on its law's graph. In the units F and X the distance from the graph is, up to a factor of √2, the natural
/// residual |λ − P(λ + ρx)|/F with ρ = F/X. Hence it depends neither on units, nor (without gaps) on the size of the load
/// or of the stiffness. With ρ the stiffness that a row sees, the rounding of a displacement that is great beside the
/// strains would count as a force. Each number is the greatest of all parts.
struct Residual {
  double equilibrium = 0;      ///< ‖Ku + Bᵀλ − f‖ / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖); where f = 0, / √ε ‖|K||u|‖ if that is more
  double penetration = 0;      ///< greatest (Bu − c)⁺ over unilateral rows / X
  double complementarity = 0;  ///< Σ|λ (Bu − c)| over unilateral rows / (|energy| + Σ|λ c| + that movement's work);
                               ///< where f = 0, + √ε |u|ᵀ|K||u|
  double law = 0;              ///< greatest |λ − P(λ + ρx)| / F of all rows, ρ = F/X: whatever the law, friction included
  double friction = 0;         ///< greatest violation of a friction bound / the greatest bound
  double energy = 0;           ///< the state's: see energy()
  /// How far the state is from its laws: the greatest of penetration, complementarity and law.
  double laws() const { return std::max({penetration, complementarity, law}); }
};

Residual residual(const Problem& problem, const State& state);

/// The greatest of Residual::penetration and law: mostly without a pass over K.
double distance_from_laws(const Problem& problem, const State& state);

/// The size of Residual::equilibrium that rounding alone explains, with one rounding error in each product of K u:
/// ε‖|K||u|‖ / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖), the greatest of all parts.
double rounding_of_equilibrium(const Problem& problem, const State& state);

/// By row, the error of its force that one rounding error in each product of Ku may make: ε(|B||K||u|)_r / Σ_j B_rj². It is comparable to
/// the force where cells are so thin that their stiffness times the displacement is 1/ε of it. 0 for rows that are open by more than a
/// millionth of X.
algebra::Vector rounding_of_forces(const Problem& problem, const State& state);

/// F and X of each row, those of its part (see Parts); 1 where they would vanish.
struct Scales {
  double force = 1, length = 1;
};
std::vector<Scales> scales(const Problem& problem, const State& state);

/// "equilibrium 1e-16, penetration 0, complementarity 0, friction 0, law 2e-16".
std::string describe(const Residual& residual);

/// The equilibrium residual told apart from the rounding of motions as a whole. A block that is free but for its rows moves by w, the part of
/// u in its kernel R: Kw = 0, but of a rounded w about ε|K||w|, however small the forces are. Such a residual says nothing against u and λ: it is
/// granted up to 4ε‖|K||w|‖, and the resultants are asked for instead, Rᵀ(Bᵀλ − f) = 0, which no rounding of w enters as RᵀK = 0. Where f = 0,
/// forces below √ε‖|K||u|‖ are no scale here either.
struct MotionResidual {
  double beyond = 0;      ///< √Σ (‖Ku + Bᵀλ − f‖ − 4ε‖|K||w|‖)⁺², norms of each block / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖) of the part
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
algebra::Vector distances_from_laws(const Problem& problem, const algebra::Vector& x, const algebra::Vector& lambda, const algebra::Vector& rho);

/// The norm of all distances / ‖λ‖ (the numerator alone where λ = 0), the natural residual.
double natural_residual(const Problem& problem, const algebra::Vector& x,
                        const algebra::Vector& lambda, const algebra::Vector& rho);

}  // namespace dotyk::problem
