#pragma once

#include <memory>

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Free bodies with given friction by magnetic screws (TR965 2.2, 3.2 (3.32)–(3.33), remark 3.5): contact rows taken as closed and, where
/// contact leaves motions along it free, friction rows taken as stuck, the report's p(v) = 0, hold all motions. Their multipliers follow
/// from equilibrium, so that `inner` works on a problem without motions (HeldByScrews). A screw that pulls, or bears more than its friction bound, is moved and the problem solved again.
struct WithScrews : RowMethod {
  std::shared_ptr<const RowMethod> inner;
  /// Rows on which the screws are placed first; empty: chosen.
  std::vector<int> screws;
  int max_moves = 50;
  const char* name() const override { return name_.c_str(); }
  void iterate(RowIteration& iteration) const override;
  /// Throws InputError for Coulomb friction, whose bound at a screw is not known.
  void require_treatable(const problem::Problem& problem) const override;

  explicit WithScrews(std::shared_ptr<const RowMethod> method);

 private:
  std::string name_;
};

}  // namespace dotyk::solver
