#pragma once

#include "base/monitor.hpp"
#include "base/stopwatch.hpp"
#include "shape/optimise/optimiser.hpp"

namespace dotyk::shape {

/// A design in x = (α − lower) / (upper − lower) ∈ [0, 1]ⁿ, objective and constraints divided by the scales of Stopping.
struct ScaledDesign {
  Vector x;
  Evaluation value;      ///< scaled
  double violation = 0;  ///< Σ max(0, c_j), scaled
  Vector alpha;          ///< as asked for
  Evaluation given;      ///< as given
};

/// −min gᵀd over x + d ∈ [0, 1]ⁿ, c + A d ≤ max(c, 0), and its multipliers (m).
struct Stationarity {
  double gap = 0;
  Vector multipliers;
};
Stationarity stationarity(const ScaledDesign& design);

/// A design problem scaled, its designs counted, recorded and told of.
class ScaledProblem {
 public:
  /// Evaluates the first design. Throws InputError for bounds or a start that do not fit, and where it is not admissible.
  ScaledProblem(const DesignProblem& problem, const Vector& start, const Stopping& stopping, Monitor& monitor);

  const ScaledDesign& first() const { return first_; }
  const Stopping& stopping() const { return stopping_; }
  Eigen::Index variables() const { return range_.size(); }
  Eigen::Index constraints() const { return constraint_scale_.size(); }
  bool is_free(Eigen::Index i) const { return range_[i] > 0; }

  /// One more design; nothing where it is not admissible, or where its evaluation was interrupted: then it is not counted, nor to be
  /// judged. Throws InputError for an evaluation of wrong sizes or numbers.
  std::optional<ScaledDesign> evaluate(const Vector& x);
  bool interrupted() const { return interrupted_; }
  /// Records the last design evaluated and tells of it.
  void judge(bool accepted, double radius, double gap);
  /// Why no further design may be evaluated; empty: it may.
  std::string must_end();
  bool feasible(const ScaledDesign& design) const { return design.violation <= stopping_.tol_violation; }

  /// Ends at `best`. Never converged where that violates constraints: the reason then says so.
  Optimum finish(const ScaledDesign& best, const Stationarity& at, double radius, bool converged, std::string reason);

 private:
  Vector unscaled(const Vector& x) const;
  Evaluation checked(const Vector& alpha, Evaluation value) const;
  ScaledDesign scaled(Vector x, Vector alpha, Evaluation given) const;

  const DesignProblem& problem_;
  Stopping stopping_;
  Monitor& monitor_;
  Stopwatch watch_;
  Vector range_, constraint_scale_;
  double objective_scale_ = 1;
  ScaledDesign first_;
  bool interrupted_ = false;
  std::vector<DesignRecord> history_;
};

}  // namespace dotyk::shape
