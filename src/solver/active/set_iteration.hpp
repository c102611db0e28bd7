#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "base/stopwatch.hpp"
#include "problem/measure.hpp"
#include "solver/active/held_stiffness.hpp"
#include "solver/active/pdas.hpp"
#include "solver/active/screws.hpp"
#include "solver/core/require_solvable.hpp"

namespace dotyk::solver {

/// Newton steps on λ = P(λ + ρx) for one problem: the linearisation that they go on from, the state that they leave, and what is factored for them.
class SetIteration {
 public:
  /// `confirmed`: two steps in a row have the same branches. `misplaced`: a screw pulls and has nowhere to go. `cycle`: branches that were there before.
  /// With friction `confirmed` means that the state is off its laws by tol at most.
  enum class End { confirmed, misplaced, cycle, singular, exhausted, interrupted };

  /// On all unknowns from the settings' state `from`, where there is one; else from the rows that `start` names, else from those that touch at rest.
  /// Throws InputError where a body is not held, naming its motion.
  SetIteration(const problem::Problem& problem, const Pdas& settings, Monitor& monitor);
  SetIteration(const SetIteration&) = delete;  // `rigid` is its own

  /// At most so many steps; fewer where they crawl after more than `patience`.
  End iterate(int most, int patience);
  int left() const { return settings.max_iterations - result.iterations; }
  /// Goes on from a state (λ, x).
  void go_on_from(const algebra::Vector& lambda, const algebra::Vector& x) { l = held(linearise(problem, lambda, x, rho), x); }
  /// What rounding leaves on rows that touch without force.
  problem::Nothing rounding(const algebra::Vector& lambda, const algebra::Vector& x) const { return measure.nothing(1e-13, lambda, x); }
  /// The linearisation with rows added where a rigid motion would be free.
  Linearisation held(Linearisation l, const algebra::Vector& x) const;
  /// Factored on first use.
  const problem::CondensedProblem& condensed();
  HeldStiffness& stiffness();
  /// "node 12 of 'b' at (0, 1), …": the rows that changed last.
  std::string places() const;
  /// The state as it was left: the rows' λ, and u.
  problem::State state();

  const problem::Problem& problem;
  const Pdas& settings;
  Monitor& monitor;
  Result result;
  const Solvable solvable;
  const problem::RigidMotions& rigid = solvable.rigid;
  const problem::Measure measure;  ///< law and bodies of a row yield one after the other
  const algebra::Vector rho;       ///< of the rows
  Linearisation l;
  algebra::Vector lambda, x;
  std::optional<algebra::Vector> alpha;    ///< of rigid motions, where λ is not the last step's
  std::optional<problem::Displacement> settled;  ///< u of another method
  std::optional<Screws> screws;
  std::unique_ptr<Step> step;
  /// At rows or at a state that the settings name.
  bool begins_somewhere() const { return !settings.start.empty() || (settings.from && !settings.reduced); }
  bool is_condensed() const { return condensed_ != nullptr; }
  bool is_analysed() const { return stiffness_ != nullptr; }
  int linear_iterations() { return stiffness().solver().iterations() - iterations_before_; }  ///< of this solve

 private:
  void begin_from(const problem::State& from);
  void place_screws();
  void note_screws() { result.screws.push_back({screws->rows(), screws->regularity(), screws->determinant()}); }
  double rounding_of_screws() const;
  bool move_screws();
  bool crawls() const;
  std::optional<End> advance();
  Linearisation follow();
  double off() const;
  bool shorten(const algebra::Vector& from_lambda, const algebra::Vector& from_x);
  bool repeats(const Linearisation& next) const;
  bool at_rest(const Linearisation& next) const;
  void record(const Linearisation& next);

  problem::Condenser own_;
  const problem::CondensedProblem* condensed_ = nullptr;
  int iterations_before_ = 0;                 ///< of the linear solver, where another solve has used it
  std::shared_ptr<HeldStiffness> stiffness_;  ///< of the held form, and of the interior point method
  std::vector<int> changed_;
  std::set<std::size_t> seen_;
  Stopwatch watch_;
};

/// What goes on where Newton steps of active sets do not come to rest. Each says in words what it has done, nothing where it has not been of use.
using Rescue = std::string (*)(SetIteration&, SetIteration::End);

/// Those that leave a linearisation to go on from, in the order in which they are tried:
///   Gauss–Seidel sweeps that decrease the dual energy, of cycles, trying a Newton step after every few until one confirms its own active set;
std::string by_sweeps(SetIteration& it, SetIteration::End end);
///   a barrier method on the condensed rows;
std::string by_barrier(SetIteration& it, SetIteration::End end);
///   an interior point method on the unknowns, once.
std::string by_interior_point(SetIteration& it, SetIteration::End end);

/// Those that leave a solution (result.converged, λ and `settled`), and their reason; `why` they are asked:
///   the active-set method of programs, from rest, which ends where laws are unilateral or linear;
bool by_active_set(SetIteration& it, const std::string& why);
///   the proximal point method, which converges from everywhere as the energy is convex, whatever the laws.
bool by_proximal(SetIteration& it, const std::string& why);

/// Where laws are off by more than rounding explains: a step of refinement, the same on all unknowns, the proximal point method.
void confirm_laws(SetIteration& it);

}  // namespace dotyk::solver
