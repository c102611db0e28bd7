#pragma once

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// A motion of a whole body: x moves by translation + rotation × (x − about).
struct RigidMotion {
  mesh::Point translation{}, rotation{}, about{};
};

/// The same solution with one body moved rigidly. Where a solution is unique up to a rigid motion, all these are solutions, with the same forces and energy. A
/// solve gives the one of least displacement; TR965 chooses the one with p(v) = 0, (1.77)–(1.78). Throws InputError where supports resist the motion, where
/// contacts or laws do not allow it, and for a step that is not the last of its history.
std::shared_ptr<Solution> moved_rigidly(const Solution& solution, int body, const RigidMotion& motion);

}  // namespace dotyk::scene
