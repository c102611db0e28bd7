#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shape/optimise/optimiser.hpp"
#include "shape/derivative/quantity.hpp"

namespace dotyk::shape {

/// q(α) ≤ most.
struct DesignConstraint {
  std::shared_ptr<const Quantity> quantity;
  double most;
};

/// What an optimisation has cost.
struct EvaluatorCost {
  Cost designs;               ///< of the designs themselves
  double analysis_seconds = 0;
  Cost beside;                ///< of the designs beside them, for differences
  double derivative_seconds = 0;
};

/// Evaluates designs for an optimiser, each contact problem begun from the contacts of the last one.
class Evaluator {
 public:
  /// `step`: 0, or h of forward differences (q(α + h e_i) − q(α))/h instead of exact derivatives, to compare.
  Evaluator(std::shared_ptr<const DesignSpace> space, solver::Method method, std::shared_ptr<const Quantity> objective,
            std::vector<DesignConstraint> constraints, double step, Monitor& monitor)
      : space_(std::move(space)), method_(std::move(method)), sought_(std::move(constraints)), step_(step), monitor_(monitor) {
    sought_.insert(sought_.begin(), {std::move(objective), 0});
  }

  /// Nothing where the design is not admissible: cells inverted, bodies that overlap, no solution, none found, no
  /// derivatives; refusal() says why. Throws Interrupted.
  std::optional<Evaluation> operator()(const Vector& alpha);
  const std::string& refusal() const { return refusal_; }
  /// Of the last design evaluated that was admissible; null before the first.
  const std::shared_ptr<const DesignState>& last() const { return last_; }
  EvaluatorCost cost() const { return {*designs_, analysis_seconds_, *beside_, derivative_seconds_}; }

 private:
  std::shared_ptr<const DesignState> solved(const Vector& alpha, const std::shared_ptr<Cost>& cost);
  Vector values(const DesignState& state) const;
  DenseMatrix exact(const DesignState& state) const;
  DenseMatrix differences(const DesignState& state, const Vector& at);

  std::shared_ptr<const DesignSpace> space_;
  solver::Method method_;
  std::vector<DesignConstraint> sought_;  ///< the objective first
  double step_;
  Monitor& monitor_;
  std::shared_ptr<Cost> designs_ = std::make_shared<Cost>(), beside_ = std::make_shared<Cost>();
  double analysis_seconds_ = 0, derivative_seconds_ = 0;
  std::shared_ptr<const DesignState> last_;
  std::string refusal_;
};

}  // namespace dotyk::shape
