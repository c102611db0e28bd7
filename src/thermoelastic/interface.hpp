#pragma once

#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "solver/core/method.hpp"
#include "thermoelastic/model.hpp"

namespace dotyk::thermoelastic {

/// What of a method's runs is worth telling.
struct Work {
  std::string method, reason;  ///< of the last problem
  int problems = 0, iterations = 0;
};

/// The problem of a step on the unknowns at the supports and ends alone, w: minimise ½wᵀSw − gᵀw + the supports' energies.
/// S is the same in every step; its kernel are the motions without strain.
class Interface {
 public:
  /// `parts`: those whose supports it is about; `gamma`: their unknowns w among all u; S: on these.
  Interface(const Model& model, std::vector<int> parts, const std::vector<int>& gamma, const algebra::DenseMatrix& S);

  /// w, for g, the load's resultants Rᵀf on the motions of the parts one after the other, and the supports' places; and into `reactions` the forces of
  /// the supports on it, part by part as Part::held. Throws InputError where there is no solution, naming the motion that nothing
  /// stops, or where the method did not converge.
  algebra::Vector solve(algebra::Vector g, const algebra::Vector& resultants, const SupportsDriven& driven, double t,
                        const solver::Method& method, std::vector<algebra::Vector>& reactions, Work& work, Monitor& monitor);

 private:
  void require_solvable(double t);

  const Model& model_;
  std::vector<int> parts_;
  problem::Problem problem_;
  std::shared_ptr<problem::Condenser> condenser_ = std::make_shared<problem::Condenser>();
  algebra::Vector solvable_;  ///< resultants of the load that was last found to have a solution
};

}  // namespace dotyk::thermoelastic
