#pragma once

#include <functional>

#include "problem/rigid_motions.hpp"
#include "solver/active/held_stiffness.hpp"
#include "solver/core/solver.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {

/// The primal-dual active set method (TR965 (1.44)–(1.47)), which is Newton's method on
/// λ = P(λ + ρ(Bu − c)) and so takes every scalar law: in each iteration the branch of every
/// row is read off y = λ + ρx, then a linear problem is solved; it ends when two in a row have the same branches. On all unknowns it takes friction
/// as well (Alart and Curnier 1991; active sets of points: Hüeber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30 (2008)): steps then converge as
/// Newton's, are shortened where they lead away, and end when the state is off its laws by `tol`.
struct Pdas : Settings {
  /// Multiplies each row's own stiffness Σ_j B_rj² K_jj (force per displacement): with 1, forces
  /// and gaps weigh alike. It matters only while both λ and x of a row are nonzero, that is
  /// from the second linear solve on not at all for contact.
  double rho = 1.0;
  /// On the condensed problem (one sparse factorisation in all), or on all unknowns (held_step; one factorisation an iteration): the same iterates
  /// (TR965 remark 1.3).
  bool reduced = true;
  /// Where not reduced, without friction: begun where an interior point method ends (interior_start; not counted among iterations) unless `start`
  /// or `from` says where: for problems with many rows of few unknowns each. The iterates from one start are the same again.
  bool interior = false;
  /// What solves the linear systems of all unknowns; empty: a sparse Cholesky factor.
  MakeSpdSolver linear;
  MakeSpdSolver linear_or_factor() const { return linear ? linear : factor(ordering); }
  /// Where coarser meshes are known and neither `start` nor `from` is given, the iteration begins at the solution on the next coarser mesh; see coarse_start().
  /// Where that does not converge, it begins once more from zero displacement, with the iterations that are left.
  bool nested = false;
  /// Made of this problem before, with `linear` and a monitor that outlives it; null: the solve makes it.
  std::shared_ptr<HeldStiffness> stiffness;
  /// The result is only the start of another iteration, as on a finer mesh: where active sets repeat it counts as converged, and no rescue is tried.
  bool rough = false;
  /// What solves the linear problem of an iteration in its place, without friction; empty: held_step.
  std::function<std::unique_ptr<Step>(const problem::Problem&, const problem::RigidMotions&, const algebra::Vector& rho)>
      step;
  /// How the rigid motions of free bodies are treated: exactly, as constraints of the dual, or by
  /// magnetic screws (TR965 1.2.2; reduced form only).
  enum class Kernel { exact, screws } kernel = Kernel::exact;
  /// Rows on which the screws are placed first; empty: chosen.
  std::vector<int> screws;
  /// Screws whose multiplier comes out negative are moved, at most so many times in all.
  int max_moves = 50;
};

/// On all unknowns, begun on coarser meshes where they are known, linear systems by conjugate gradients with multigrid.
struct Multigrid : Pdas {
  static constexpr bool takes_linear = true;
  Multigrid() { reduced = false, nested = true, linear = multigrid(Levels::meshes); }
};

/// Solves. Where Newton steps cycle, meet a singular problem or crawl (after fourteen steps still as many rows change), rescues follow one
/// another (set_iteration.hpp). Each has steps of its own, told in `reason` and not among `iterations`; Newton steps confirm what it found,
/// whatever max_iterations says.
/// Throws InputError where a body is not held, naming its motion.
Result solve(const problem::Problem& problem, const Pdas& settings, Monitor& monitor);

}  // namespace dotyk::solver
