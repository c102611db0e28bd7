#pragma once

#include <string>
#include <vector>

#include "scene/model/model.hpp"
#include "scene/statement/scene.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::scene {

/// As solver::settle(). A rotation that contact no wider than its cells resists is named as well. Contact rows whose pressure is rounding
/// are open.
void settle(const Scene& scene, const Model& model, const problem::Problem& problem, const algebra::Vector& before, solver::Result& result);

}  // namespace dotyk::scene
