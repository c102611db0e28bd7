#pragma once

#include "scene/solution.hpp"

namespace dotyk::scene {

/// Does what a contact's friction bears depend on the way of the load? Where nodes that rub closed from a gap (or opened a pressure fit):
/// a single step takes all of the jump since rest for slip, also what came before the node closed. Where all gaps of closed nodes are 0,
/// a solution under Coulomb friction at a part of the load is that part of it, and one step is exact.
bool follows_path(const Solution& solution);

/// How far one load step is from two: Σ|λ_t − λ_t'| over the points of friction in Σ|λ_t'|, λ_t' their forces if half of the load, the
/// prescribed displacements and the rigid shapes' displacements is applied first. Of a solution without steps before it; it is solved
/// twice more, with one factorisation, by the default method. 0 unless follows_path(). The error itself is some twice that, and more where
/// loads close most of the nodes. Throws InputError for a solution that follows another, or where the halves do not converge.
double estimate_path_error(const Solution& solution, Monitor& monitor);

}  // namespace dotyk::scene
