#pragma once

#include <memory>
#include <vector>

#include "algebra/types.hpp"
#include "scene/statement/scene.hpp"
#include "shape/derivative/velocities.hpp"

namespace dotyk::shape {

/// The designs of a scene: nodes at X(α) = X₀ + Σ α_i V_i, X₀ as the scene was set up.
class DesignSpace {
 public:
  /// Throws InputError for no variables, and where a V_i has not one list a body, each empty or of the body's size and finite, or
  /// moves nothing.
  DesignSpace(std::shared_ptr<const scene::Scene> scene, std::vector<Velocities> variables);

  const scene::Scene& first() const { return *scene_; }
  int variables() const { return static_cast<int>(variables_.size()); }
  const Velocities& variable(int i) const { return variables_[static_cast<std::size_t>(i)]; }
  /// Σ β_i V_i.
  Velocities along(const algebra::Vector& beta) const;
  /// That of the one variable t with V = Σ β_i V_i.
  DesignSpace line(const algebra::Vector& beta) const { return {scene_, {along(beta)}}; }
  /// The scene at α; throws as scene::moved.
  std::shared_ptr<scene::Scene> at(const algebra::Vector& alpha) const;

 private:
  std::shared_ptr<const scene::Scene> scene_;
  std::vector<Velocities> variables_;
};

}  // namespace dotyk::shape
