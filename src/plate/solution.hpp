#pragma once

#include <memory>
#include <optional>

#include "base/monitor.hpp"
#include "plate/loads.hpp"
#include "plate/solvable.hpp"
#include "problem/residual.hpp"
#include "solver/core/method.hpp"
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
  double deflection(const Place& place) const { return values(place, u_)[0]; }
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

/// How far one solution is from another, relative to the other.
struct Distance {
  double energy = 0;        ///< √∫ D (κ − κ')ᵀC(κ − κ') / √∫ D κ'ᵀCκ', curvatures cell by cell, D and ν of the other
  double displacement = 0;  ///< ‖u − u'‖ / ‖u'‖ in L²
};

/// By the load rule of whichever mesh has more cells; points that are not on both plates are left out. Throws InputError where no point is, or the other is zero.
Distance distance(const Solution& solution, const Solution& other);

/// Solves; see run() for the method where none is named. Where the solution is unique up to one motion, one is given, and with it the family of
/// all (see solve_limit_case()); of the free plate that with (u, 1) = (u, x) = (u, y) = 0 (P5, lemma 1).
/// Throws InputError where there is no solution (see require_solvable), and where the method cannot treat a law.
std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::plate
