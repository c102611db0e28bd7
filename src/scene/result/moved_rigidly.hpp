#pragma once

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// A motion of a whole body: x moves by translation + rotation × (x − about).
struct RigidMotion {
  mesh::Point translation{}, rotation{}, about{};
};

/// Another member of a solution that is unique up to a rigid motion: one body moved by this one, forces and energy the same. The choice that TR965 makes
/// by p(v) = 0 (1.77)–(1.78), where dotyk gives the least displacement. Throws InputError where the body's supports resist the motion, where the laws do not
/// allow it, or of a step that is not the last of its history.
std::shared_ptr<Solution> moved_rigidly(const Solution& solution, int body, const RigidMotion& motion);

}  // namespace dotyk::scene
