#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "shape/derivative/bordered.hpp"
#include "shape/derivative/boundary_motion.hpp"

namespace dotyk::shape {

/// What moving nodes change in a problem at a given state.
struct Change {
  algebra::Vector f;      ///< f̃ = f' − K'u − B'ᵀλ, unknowns: force per unit of the design variable
  algebra::Vector c;      ///< c̃ = c' − B'u, rows: length
  algebra::Vector bound;  ///< g' of each point of given friction, at the first of its rows: force
};

/// The derivative of a state along a motion of the nodes.
struct Derivative {
  algebra::Vector u, lambda;  ///< unknowns; rows
  algebra::Vector x;          ///< of Bu − c, rows: less than 0 where a row opens
  std::vector<std::vector<double>> displacement;  ///< of each node as it moves: body → node × dimension, 0 where prescribed
};

/// The gradient of a function J of (u, λ) by what changes: J' = f·f̃ + c·c̃ + bound·g' for every motion of the nodes, besides
/// what J depends on the nodes' places themselves.
struct Adjoint {
  algebra::Vector f, c, bound;
  double along(const Change& change) const { return f.dot(change.f) + c.dot(change.c) + bound.dot(change.bound); }
};

/// Throws InputError where a solution has not converged, or is one of a penalised problem.
void require_solution(const scene::Solution& solution);

/// The derivatives of the solution of a scene,
///   K u + Bᵀλ = f,   λ_r ∈ ∂φ_r((Bu − c)_r),
/// when its nodes move with a velocity V. Along V the directional derivative z = u', μ = λ' solves (P7 (15)–(17))
///   K z + Bᵀμ = f̃,   and row by row, with ξ = Bz − c̃:
///   strong contact (λ > 0), rows held, stick: ξ = 0;   open: μ = 0;   a spring: μ = kξ;
///   weak contact (touching, λ = 0): ξ ≤ 0, μ ≥ 0, μξ = 0: a quadratic program;
///   slip with the bound g: μ_t = g' d + (g/‖x_t‖)(I − ddᵀ)ξ_t, d = x_t/‖x_t‖, in the plane μ_t = ±g'; Coulomb: g' = F μ_n.
/// Exact: no differences are taken. Loads, supports, prescribed displacements and materials go with their nodes and facets,
/// pairs of nodes in contact stay pairs, tangents are differentiated with their axes kept (contact::tangent_derivatives).
/// Of motions that no row notices, z has none.
///
/// All derivatives share one factorisation, that of the solve where its condenser is given (scene::Start::condenser): each
/// takes one forward and one backward sweep a body, an adjoint as much, once for all V.
class Sensitivity {
 public:
  struct Settings {
    /// What counts as no force and no gap, see law_derivative(); what ten times the solution's own residual of its laws
    /// leaves of forces counts as nothing, too. 1e-9 is far above what exact methods leave (1e-13) and far below the pressures that meshes resolve.
    double touching = 1e-9;
    algebra::Ordering ordering = algebra::Ordering::automatic;
  };

  /// `condenser`: one that condensed this very K and B, or null. Throws InputError where the solution did not converge, is
  /// penalised, is a step of a history with friction (whose slip depends on earlier steps), has no stiffness (an
  /// earlier step), and as law_derivative() does, naming the nodes where friction has a kink.
  Sensitivity(std::shared_ptr<const scene::Solution> solution, std::shared_ptr<problem::Condenser> condenser, const Settings& settings,
              Monitor& monitor);

  const scene::Solution& solution() const { return *solution_; }
  /// Is the derivative linear in V? If not, weak() says in which rows of B there is contact without force.
  bool smooth() const { return law_.weak.empty(); }
  const std::vector<int>& weak() const { return law_.weak_row; }
  /// "node 12 of 'block' at (0.5, 0), node 13 of 'block' at (0.6, 0) and 5 more"; empty where smooth.
  std::string weak_text() const;

  /// What derivatives took so far; no ordering and factor where the condenser had them.
  const problem::Clock& clock() const { return clock_; }

  /// Throws InputError where V has not one list a body, each empty or of the body's size and finite; for a part that moves
  /// with supports, springs or contacts whose derivatives are not known.
  Change change(const Velocities& velocities) const;
  /// Throws InputError where the derivative does not exist: a motion that contact holds no longer.
  Derivative along(const Change& change) const;
  Derivative along(const Velocities& velocities) const { return along(change(velocities)); }

  /// Of J with ∂J/∂u = du (unknowns) and ∂J/∂λ = dlambda (rows; empty: 0). Throws InputError in weak contact, naming the rows,
  /// as J' is not linear in V there, and where J depends on motions that no row notices.
  Adjoint adjoint(const algebra::Vector& du, const algebra::Vector& dlambda) const;

 private:
  const problem::CondensedProblem& load(const algebra::Vector& f, const algebra::Vector& c, const char* what) const;
  algebra::Vector follow(const algebra::Vector& b) const;
  void require_differentiable() const;

  std::shared_ptr<const scene::Solution> solution_;
  std::shared_ptr<problem::Condenser> condenser_;
  Settings settings_;
  Monitor& monitor_;
  LawDerivative law_;
  mutable problem::Problem problem_;       ///< the state's without K: its f and c are those of the derivative
  mutable problem::RigidMotions rigid_;
  mutable problem::Clock clock_;
  std::optional<Bordered> bordered_;       ///< with weak contact, of which a part is factored for each V
  std::optional<BorderedFactor> factor_;   ///< without
};

}  // namespace dotyk::shape
