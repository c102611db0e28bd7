#pragma once

#include <limits>
#include <optional>
#include <string>

#include "base/stopwatch.hpp"
#include "problem/measure.hpp"
#include "solver/rows/natural_map.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// The Measure of a condensed problem, whose rows are as stiff as W says, so that one number says of an iterate how far it is from the laws:
/// ‖λ − P(λ + ρx)‖ / F, the least for any x within rounding. F is that of each part's multipliers, and at least Measure::least_force().
///
/// A greater ρ asks more of gaps. A row's force is known to tol F only where ρ_r is not below the stiffness that the row sees; a gap that is
/// great beside the displacements X must count as well. Hence ρ_r = max(1/W_rr, F/max(X, |c_r|)). X is at least what the
/// greatest multiplier moves the stiffest row by.
///
/// x is a sum of terms. Where a body moves as a whole far more than it deforms, only their rounding may be left in x.
class RowMeasure {
 public:
  RowMeasure(const problem::Problem& problem, const problem::CondensedProblem& condensed);

  /// 1/W_rr.
  const algebra::Vector& stiffness() const { return measure_.stiffness(); }
  /// F by row, that of its part.
  algebra::Vector forces(const algebra::Vector& lambda) const;
  struct Rho {
    algebra::Vector rho;
    algebra::Vector rounding;  ///< by row, of x
  };
  Rho rho(const algebra::Vector& lambda, const algebra::Vector& x, algebra::Vector rounding) const;

 private:
  algebra::Vector by_row(const std::vector<double>& of_part) const;

  algebra::Vector c_;
  problem::Measure measure_;
};

/// A method at work on a condensed problem: the iterate (λ, α), what the natural map says there, the
/// history it writes and how it ends. The natural map has ρ_r = rho/W_rr, 1/W_rr the stiffness
/// that a row sees.
class RowIteration {
 public:
  RowIteration(const problem::Problem& problem, const problem::CondensedProblem& condensed, const Settings& settings,
               double rho, Monitor& monitor);
  /// One of the same rows under other laws, whose problem need not have bodies: forces count as in `outer`.
  RowIteration(const problem::Problem& problem, const RowIteration& outer, const Settings& settings, double rho, Monitor& monitor);
  RowIteration(const RowIteration&) = delete;  // `map` is its own
  RowIteration& operator=(const RowIteration&) = delete;

  const problem::Problem& problem;
  const problem::CondensedProblem& condensed;
  const NaturalMap& map = map_;

  /// The rows about the last state that was recorded, where x₀ − Wλ + Nα would lose the digits that count.
  const problem::CondensedProblem& rows() const { return centred_ ? *centred_ : condensed; }

  const Iterate& at() const { return at_; }
  const algebra::Vector& lambda() const { return at_.lambda; }
  const algebra::Vector& alpha() const { return at_.alpha; }
  const NaturalMap::Value& value() const { return value_; }
  /// x = x₀ − Wλ + Nα of the iterate.
  const algebra::Vector& jump() const { return value_.x; }
  /// Of the iterate: its distance from the laws and the forces out of balance, beyond rounding, against the forces that count; see RowMeasure. It
  /// does not depend on the map's ρ: a small one would let the force of a slipping point pass in whatever direction.
  double residual() const;
  /// Is that less than tol for rounding alone?
  bool at_rounding() const;
  /// By row, the force that the iterate's errors are measured by (RowMeasure::forces()); 1 where it would vanish.
  algebra::Vector forces() const;
  /// By row, how far rounding may put the iterate's jump off, a displacement.
  algebra::Vector rounding() const { return rounding(at_); }
  algebra::Vector rounding(const Iterate& of) const { return rows().rounding(of.lambda, of.alpha); }
  /// ‖λ − P(λ + ρx)‖ of the iterate: F without what is out of balance.
  double law_residual() const { return (at_.lambda - value_.projected).norm(); }
  void move_to(Iterate iterate);

  /// Starts from here, in place of λ = 0 and α = 0.
  void begin_at(Iterate iterate);
  /// Was it told where to start?
  bool begun() const { return begun_; }

  /// Begins an iteration; false after the last one allowed, or where the user stops.
  bool next();
  /// The displacements of an iterate, by one solve with the factors; and with their equilibrium corrected once, as far as rounding lets it.
  algebra::Vector recovered(const Iterate& of) const;
  algebra::Vector displacements(const Iterate& of) const;
  /// Writes the iterate into the history, with what `info` says beyond that; true where its residual is within tol.
  bool record(IterationInfo info = {});
  /// The residual's least value has not fallen by a hundredth in the last `patience` iterations, or the
  /// multipliers are beyond all measure. Gives up then.
  bool stalled(int patience = 2000);
  /// Allows so many iterations more, to another method, from where this one began. The natural map is from now on that of
  /// ρ_r = 1/W_rr: what this method's `rho` makes of rounding is not to count against another.
  void grant(int more);
  /// Was the last iterate recorded within tol?
  bool converged() const { return result_.converged; }
  /// Ends here where the best iterate is a solution to rounding, though tol asks for more: its displacements are recovered and judged as results are.
  bool accept();
  /// Was the last iterate recorded within tol, and do its displacements bear that out? Great multipliers that balance each other are measured by themselves here.
  bool stands() const;
  /// Gives up, for this reason.
  void give_up(std::string reason) { result_.reason = std::move(reason); }
  /// Magnetic screws, where they are now.
  void note(ScrewPlacement screws) {
    result_.screws.push_back(std::move(screws));
    result_.screw_moves = static_cast<int>(result_.screws.size()) - 1;
  }
  /// Adds a remark to the reason, however the method ends.
  void remark(std::string text) { remarks_.push_back(std::move(text)); }

  int iterations() const { return result_.iterations; }
  Monitor& monitor() const { return monitor_; }
  /// The result of the iterate (without convergence: of the one of least residual recorded), without
  /// displacements.
  Result finish();

 private:
  RowIteration(const problem::Problem& problem, RowMeasure measure, const problem::CondensedProblem& condensed, const Settings& settings,
               double rho, Monitor& monitor);
  RowMeasure::Rho rho() const { return measure_.rho(at_.lambda, value_.x, rounding()); }
  double lost() const;
  void centre();
  void centre(const Iterate& at, algebra::Vector u);
  void go_to_best();
  void record_active_set();
  double off_laws(bool beyond_rounding) const;

  RowMeasure measure_;
  NaturalMap map_;
  const Settings& settings_;
  Monitor& monitor_;
  Result result_;
  std::shared_ptr<const problem::CondensedProblem> centred_;  ///< null: not yet
  Iterate centre_;
  algebra::Vector u_;       ///< displacements there
  double lost_ = 0;         ///< lost() there
  algebra::Vector best_u_;  ///< of best_; empty: recovered
  bool begun_ = false;
  Iterate at_, first_, best_;  ///< first_: where it began; best_: of least residual; empty: none yet
  double best_residual_ = std::numeric_limits<double>::infinity();
  double milestone_ = std::numeric_limits<double>::infinity();  ///< the last residual below all before by a hundredth
  int at_milestone_ = 0;
  NaturalMap::Value value_, recorded_;
  std::vector<std::string> remarks_;
  std::optional<double> accepted_;  ///< how far off its laws the state is that was accepted
  Stopwatch watch_;
  int allowed_;  ///< iterations
};

/// A method that works on the condensed problem alone.
struct RowMethod : Settings {
  virtual ~RowMethod() = default;
  virtual const char* name() const = 0;
  /// What multiplies 1/W_rr, the stiffness (force per displacement) that each row sees, to the ρ of the
  /// natural map.
  virtual double map_weight() const { return 1.0; }
  virtual void iterate(RowIteration& iteration) const = 0;
  /// Do other methods go on where this one cannot?
  virtual bool hands_over() const { return false; }
  /// Throws InputError where it cannot treat a law, naming the law.
  virtual void require_treatable(const problem::Problem& /*problem*/) const {}
};

/// Condenses, iterates and recovers the displacements. Throws InputError where there is no solution,
/// naming the motion.
Result solve(const problem::Problem& problem, const RowMethod& method, Monitor& monitor);

/// Iterates on a problem already condensed and recovers its displacements; whether it has a solution is
/// the caller's to know. The clock and the factor's size are added by the caller.
Result solve(const problem::Problem& problem, const problem::CondensedProblem& condensed, const RowMethod& method,
             Monitor& monitor);

}  // namespace dotyk::solver
