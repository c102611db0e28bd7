#pragma once

#include <optional>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// Does what a contact's friction bears depend on the way of the load? Where nodes that rub closed from a gap (or opened a pressure fit):
/// a single step takes all of the jump since rest for slip, also what came before the node closed. And where a contact without friction
/// closed from a gap: before, bodies may have gone where it then did not let them go on. Where all gaps of closed nodes are 0,
/// a solution under Coulomb friction at a part of the load is that part of it, and one step is exact.
bool follows_path(const Solution& solution);

/// The share of friction's force, Σ|λ_t|, at points that closed on the way and stick at the end. Where points slip, |λ_t| is its bound and does
/// not depend on the way. All of it where a contact without friction closed on the way. Nothing unless follows_path().
std::optional<double> share_of_path(const Solution& solution);

/// How far one load step is from kPathSteps equal ones of the load, the prescribed displacements and the rigid shapes' displacements:
/// Σ|λ_t − λ_t'| over the points of friction in Σ|λ_t'|, λ_t' their forces after the steps. A node that sticks where a share τ of the load
/// has closed it bears 1/(1 − τ) times too much after one step; by two steps that is not seen if τ < ½, by n if τ < 1/n. Of a solution
/// without steps before it; the steps have one factorisation and the default method. 0 unless follows_path(). Throws InputError for a
/// solution that follows another, or where the steps do not converge.
inline constexpr int kPathSteps = 8;
double estimate_path_error(const Solution& solution, Monitor& monitor);

}  // namespace dotyk::scene
