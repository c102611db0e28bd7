#pragma once

#include <string>
#include <vector>

#include "scene/model.hpp"
#include "scene/scene.hpp"
#include "solver/solver.hpp"

namespace dotyk::scene {

/// Of a state that has converged, what problem::free_motions() finds: adds to the reason which motion its displacement is unique up to, and
/// how far that may go. Where it is one, the state becomes, of those that differ by it, the one nearest to `before` (unknowns; at rest: the
/// least), which no method then decides. A rotation that contact no wider than its cells resists is named as well. Contact rows whose
/// pressure is rounding are open.
void settle(const Scene& scene, const Model& model, const problem::Problem& problem, const algebra::Vector& before, solver::Result& result);

}  // namespace dotyk::scene
