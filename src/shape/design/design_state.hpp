#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "shape/derivative/sensitivity.hpp"
#include "solver/core/method.hpp"

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

/// What states have cost so far.
struct Cost {
  int analyses = 0;          ///< scenes solved
  long long iterations = 0;  ///< of them
  int derivatives = 0;       ///< linear and quadratic problems solved for derivatives, adjoint ones included
};

/// One design solved, and its derivatives by the variables, made when asked for.
class DesignState : public std::enable_shared_from_this<DesignState> {
 public:
  /// Moves and solves; contacts begin as those of `near` ended, if given. Throws InputError as DesignSpace::at and scene::solve do.
  DesignState(std::shared_ptr<const DesignSpace> space, algebra::Vector alpha, const solver::Method& method, const DesignState* near, std::shared_ptr<Cost> cost,
              Monitor& monitor);

  /// The same state with one variable t, that of the designs α + tβ: its derivatives are those along β (components: the variables of
  /// `state`). Throws InputError where β moves nothing.
  DesignState(const DesignState& state, const algebra::Vector& beta);

  const DesignSpace& space() const { return *space_; }
  /// The design variables, also where derivatives are along β.
  const algebra::Vector& alpha() const { return alpha_; }
  /// ∂α_k by the variables of space(): a unit vector, or β_k.
  algebra::Vector alpha_gradient(Eigen::Index k) const;
  const scene::Scene& scene() const { return *scene_; }
  const std::shared_ptr<const scene::Solution>& solution() const { return solution_; }

  /// Throws as Sensitivity's constructor.
  const Sensitivity& sensitivity() const;
  /// What V_i changes at this design; throws as Sensitivity::change.
  const Change& change(int variable) const;
  /// Along growing α_i, one-sided where the state is in weak contact; throws as Sensitivity::along.
  const Derivative& derivative(int variable) const;
  /// Throws as Sensitivity::adjoint.
  Adjoint adjoint(const algebra::Vector& du, const algebra::Vector& dlambda) const;

 private:
  std::shared_ptr<const DesignSpace> space_;
  algebra::Vector alpha_, beta_;  ///< β: empty where the variables are α
  std::shared_ptr<Cost> cost_;
  mutable Monitor idle_;  ///< of derivatives, which may be asked for when whoever watched the solve is gone
  std::shared_ptr<problem::Condenser> condenser_;
  std::shared_ptr<scene::Scene> scene_;
  std::shared_ptr<const scene::Solution> solution_;
  mutable std::shared_ptr<const Sensitivity> sensitivity_;
  mutable std::vector<std::optional<Change>> change_;
  mutable std::vector<std::optional<Derivative>> derivative_;
};

}  // namespace dotyk::shape
