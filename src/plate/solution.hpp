#pragma once

#include <memory>
#include <optional>

#include "plate/family.hpp"
#include "plate/loads.hpp"
#include "plate/model.hpp"
#include "problem/residual.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::plate {

/// M = −D[(1 − ν)∇²u + νΔu I], per length; Mₙ = nᵀMn is P5 (5).
struct Moment {
  double xx = 0, yy = 0, xy = 0;
};

/// A solved plate. Points must lie on it, else InputError.
class Solution {
 public:
  Solution(std::shared_ptr<const Model> model, solver::Result result, std::optional<Family> family);

  const Plate& plate() const { return model_->plate; }
  const Model& model() const { return *model_; }
  const solver::Result& result() const { return result_; }
  const problem::Residual& residual() const { return residual_; }
  double energy() const { return residual_.energy; }  ///< with the supports', force·length
  /// Every freedom of the model's space.
  const algebra::Vector& freedoms() const { return u_; }
  /// Where the solution is not the only one: all of them.
  const std::optional<Family>& family() const { return family_; }

  std::optional<Place> find(const Eigen::Vector2d& x) const { return finder_.find(x); }  ///< nothing where x is not on the plate
  double stiffness(int cell) const;                                                     ///< mean D of a cell
  double deflection(double x, double y) const;
  Eigen::Vector2d slope(double x, double y) const;  ///< ∇u
  /// Of the mean curvatures about each vertex, linear on a cell: of order h² within where the mesh is regular, h at the edge with Morley's element.
  Moment moment(double x, double y) const;
  double motion(double x, double y) const;  ///< of the family; 0 without one
  double vertex_deflection(int vertex) const { return u_[model_->space.of_vertex(vertex)]; }
  const std::vector<Moment>& vertex_moments() const;

 private:
  /// u, ∇u and curvatures of these freedoms.
  Eigen::Matrix<double, 6, 1> values(const Place& place, const algebra::Vector& freedoms) const;

  std::shared_ptr<const Model> model_;
  solver::Result result_;
  problem::Residual residual_;
  algebra::Vector u_;
  std::optional<Family> family_;
  Finder finder_;
  mutable std::vector<Moment> moments_;  ///< of vertices, once asked for
};

}  // namespace dotyk::plate
