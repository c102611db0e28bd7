#pragma once

#include <limits>
#include <string>

#include "base/stopwatch.hpp"
#include "problem/condensed.hpp"
#include "solver/rows/natural_map.hpp"
#include "solver/rows/row_scales.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// What some methods know of an iteration beyond its iterate; see IterationInfo.
struct IterationDetail {
  double singular_value = std::numeric_limits<double>::quiet_NaN();
  double contraction = 0;
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

  const problem::Problem& problem;
  const problem::CondensedProblem& condensed;
  const NaturalMap& map = map_;

  const algebra::Vector& lambda() const { return lambda_; }
  const algebra::Vector& alpha() const { return alpha_; }
  const NaturalMap::Value& value() const { return value_; }
  /// x = x₀ − Wλ + Nα of the iterate.
  const algebra::Vector& jump() const { return value_.x; }
  /// Of the iterate: its distance from the laws and the forces out of balance, against the forces that count; see RowScales. It does
  /// not depend on the map's ρ: a small one would let the force of a slipping point pass in whatever direction.
  double residual() const;
  /// By row, the force that the iterate's errors are measured by (RowScales::forces()); 1 where it would vanish.
  algebra::Vector forces() const;
  /// By row, how far rounding may put the iterate's jump off, a displacement.
  algebra::Vector rounding() const { return scales_.rounding(alpha_, value_.x); }
  /// ‖λ − P(λ + ρx)‖ of the iterate: F without what is out of balance.
  double law_residual() const { return (lambda_ - value_.projected).norm(); }
  void move_to(algebra::Vector lambda, algebra::Vector alpha);

  /// Starts from here, in place of λ = 0 and α = 0.
  void begin_at(algebra::Vector lambda, algebra::Vector alpha);
  /// Was it told where to start?
  bool begun() const { return begun_; }

  /// Begins an iteration; false after the last one allowed, or where the user stops.
  bool next();
  /// Writes the iterate into the history; true where its residual is within tol.
  bool record(const IterationDetail& detail = {});
  /// The residual's least value has not fallen by a hundredth in the last `patience` iterations, or the
  /// multipliers are beyond all measure. Gives up then.
  bool stalled(int patience = 2000);
  /// Allows so many iterations more, to another method, from where this one began. The natural map is from now on that of
  /// ρ_r = 1/W_rr: what this method's `rho` makes of rounding is not to count against another.
  void grant(int more);
  /// Was the last iterate recorded within tol?
  bool converged() const { return result_.converged; }
  const std::string& reason() const { return result_.reason; }
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
  struct Best {
    algebra::Vector lambda, alpha;
    double residual = std::numeric_limits<double>::infinity();
  };
  RowIteration(const problem::Problem& problem, RowScales scales, const problem::CondensedProblem& condensed, const Settings& settings,
               double rho, Monitor& monitor);
  void record_active_set();

  RowScales scales_;
  NaturalMap map_;
  const Settings& settings_;
  Monitor& monitor_;
  Result result_;
  Best best_;
  bool begun_ = false;
  double milestone_ = std::numeric_limits<double>::infinity();  ///< the last residual below all before by a hundredth
  int at_milestone_ = 0;
  algebra::Vector lambda_, alpha_;
  NaturalMap::Value value_, recorded_;
  std::vector<std::string> remarks_;
  Stopwatch watch_;
  int allowed_;  ///< iterations
  algebra::Vector first_lambda_, first_alpha_;  ///< where it began
};

/// A method that works on the condensed problem alone.
struct RowMethod : Settings {
  virtual ~RowMethod() = default;
  virtual const char* name() const = 0;
  /// What multiplies 1/W_rr, the stiffness (force per displacement) that each row sees, to the ρ of the
  /// natural map.
  virtual double map_weight() const { return 1.0; }
  virtual void iterate(RowIteration& iteration) const = 0;
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
