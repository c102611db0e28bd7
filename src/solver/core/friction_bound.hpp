#pragma once

#include <optional>

#include "base/monitor.hpp"
#include "problem/condensed.hpp"
#include "problem/solvability.hpp"

namespace dotyk::solver {

/// A motion that friction of Coulomb's alone stops, on which the load does work; see problem::Solvability.
struct FrictionalMotion {
  problem::RigidMotions rigid;
  algebra::Vector amounts;
  double work;
};

/// Nothing where something else than Coulomb's friction stops all motions.
std::optional<FrictionalMotion> stopped_by_friction_alone(const problem::Problem& problem);

/// The most work that friction under the pressures λ_n can do against a unit of the motion: Σ μ_i λ_n,i ‖N_t,i v‖.
double friction_capacity(const problem::Problem& problem, const FrictionalMotion& motion, const algebra::Vector& lambda);

/// Is it proved that the load on this motion v is more than friction can bear? With p = λ_n, every solution has p_i x_n,i = 0 and, for any |s_i| ≤ 1,
/// λ_t,i x_t,i = μ_i p_i |x_t,i| ≥ μ_i p_i s_i x_t,i. With x = x₀ − Wλ + Nα the sum of all is
///   q_s(λ) := (λ − μsp)ᵀ(Wλ − x₀) ≤ (e − μN_tᵀsp)ᵀα.
/// For s = 0 that is q₀(λ) ≤ eᵀα. For s_i along N_t,i v let N_tᵀ(μsp) be a multiple of e for all λ in balance (of a single motion it is;
/// of a block between parallel walls too). The multiple is 1 + c(λ), 1 + c = Σ μ_i p_i |N_t,i v| / eᵀv ≥ 1, so that q_s(λ) ≤ −c(λ) eᵀα.
/// Let κ be the least q₀ on the forces in balance and in the cones of friction: eᵀα ≥ κ, and q_s(λ) + c(λ) κ ≤ 0. There is no solution if
/// the least value of this on the same forces is positive. Both are convex quadratic programs (in space polygons around the discs of friction), unless μ is so great that
/// q_s is not convex. False where that is so, where another law takes part, and beyond some hundreds of rows.
bool friction_is_too_weak(const problem::Problem& problem, const problem::CondensedProblem& condensed, const FrictionalMotion& motion,
                          Monitor& monitor);

}  // namespace dotyk::solver
