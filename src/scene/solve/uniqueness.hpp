#pragma once

#include <optional>
#include <string>

#include "base/monitor.hpp"
#include "problem/uniqueness.hpp"
#include "scene/model/model.hpp"
#include "scene/statement/scene.hpp"

namespace dotyk::scene {

/// What is known of a scene's solutions before they are computed. Throws InputError where there is none, as solver::require_solvable.
struct KnownBefore {
  problem::Uniqueness theory;
  std::string text;  ///< one sentence: unique; unique stress, displacement up to a motion; or unknown before solving
};
KnownBefore known_before(const problem::Problem& problem, const problem::RigidMotions& rigid);

/// The same, and with Coulomb friction the factor of problem::uniqueness_factor(), for which the scene is condensed: as long as a solve.
struct UniquenessOfScene {
  bool exists = true, unique = false;
  std::optional<double> factor;
  std::string text;
};
UniquenessOfScene uniqueness(const Scene& scene, Monitor& monitor);

}  // namespace dotyk::scene
