#pragma once

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

/// A design problem scaled, its designs counted, recorded and told of; the best one so far, and why the search has ended.
class ScaledProblem {
 public:
  /// Evaluates and judges the first design. Throws InputError for bounds or a start that do not fit, and where it is not admissible.
  ScaledProblem(const DesignProblem& problem, const Vector& start, const Stopping& stopping, Monitor& monitor);

  const ScaledDesign& best() const { return best_; }
  const Stopping& stopping() const { return stopping_; }
  Eigen::Index variables() const { return range_.size(); }
  Eigen::Index constraints() const { return constraint_scale_.size(); }
  bool is_free(Eigen::Index i) const { return range_[i] > 0; }

  /// One more design; nothing where it is not admissible, or where its evaluation was interrupted: then it is not counted, nor to be
  /// judged. Throws InputError for an evaluation of wrong sizes or numbers.
  std::optional<ScaledDesign> evaluate(const Vector& x);
  bool interrupted() const { return interrupted_; }
  /// Records the last design evaluated and tells of it. `better`: it, scaled, where it is the best one from now on, else null.
  void judge(const ScaledDesign* better, double radius);
  bool feasible(const ScaledDesign& design) const { return design.violation <= stopping_.tol_violation; }

  void end(bool converged, std::string reason);
  bool ended() const { return !reason_.empty(); }
  /// Ends where the best design's gap is small, or no further design may be evaluated; has it ended?
  bool must_end();
  /// Ends at the best design. Never converged where that violates constraints: the reason then says so.
  Optimum finish(double radius);

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
  ScaledDesign best_;
  Stationarity at_;  ///< of the best design
  bool interrupted_ = false, converged_ = false;
  std::string reason_;
  std::vector<DesignRecord> history_;
};

}  // namespace dotyk::shape
