#include "solver/newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "problem/residual.hpp"
#include "solver/natural_map.hpp"
#include "solver/require_solvable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

class Iteration {
 public:
  Iteration(const Problem& problem, const Newton& settings, Monitor& monitor)
      : problem_(problem), settings_(settings), monitor_(monitor), rigid_(problem::rigid_motions(problem)),
        note_(require_solvable(problem, rigid_)),
        condensed_(problem, rigid_, settings.ordering, result_.clock, monitor),
        map_(problem, condensed_, settings.rho * problem.row_stiffness()) {
    result_.method = "newton";
    result_.factor_bytes = condensed_.factor_bytes();
    result_.ordering = condensed_.ordering();
  }

  Result run() {
    Stopwatch iterating;
    start();
    while (result_.iterations < settings_.max_iterations && !monitor_.stop()) {
      ++result_.iterations;
      const NaturalMap::Value before = map_.at(lambda_, alpha_);
      if (!step(before)) break;
      if (record(before)) break;
    }
    finish();
    result_.clock.iterate += iterating.lap();
    result_.state.u = condensed_.recover(lambda_, alpha_);
    result_.state.lambda = lambda_;
    result_.clock.recover += iterating.lap();
    return std::move(result_);
  }

 private:
  /// Everything that touches at rest (or is told to) sticks: one linear problem.
  void start() {
    lambda_ = Vector::Zero(problem_.rows());
    alpha_ = Vector::Zero(condensed_.kernel_size());
    solve_step(map_.sticking(settings_.start));
  }

  /// The Newton step. Whole steps change many pieces at once and may increase F on the way: they are
  /// damped only where F would exceed all of the last few values.
  bool step(const NaturalMap::Value& before) {
    const Vector lambda = lambda_, alpha = alpha_;
    if (!solve_step(before)) return false;
    const Vector lambda_step = lambda_ - lambda, alpha_step = alpha_ - alpha;
    norms_.push_back(before.norm);
    if (norms_.size() > kMemory) norms_.erase(norms_.begin());
    const double allowed = 2 * *std::max_element(norms_.begin(), norms_.end());
    double length = 1;
    for (int halving = 0; halving < kHalvings && map_.at(lambda_, alpha_).norm > allowed; ++halving) {
      length /= 2;
      lambda_ = lambda + length * lambda_step;
      alpha_ = alpha + length * alpha_step;
    }
    return true;
  }

  /// λ, α := those that solve the problem linearised in `v`.
  bool solve_step(const NaturalMap::Value& v) {
    NaturalMap::System system = map_.linearise(v);
    if (system.matrix.size() == 0) {  // everything is open
      map_.take(system, Vector(0), lambda_, alpha_);
      return true;
    }
    Eigen::PartialPivLU<DenseMatrix> lu(system.matrix);
    if (!(lu.rcond() > 1e-15)) {
      ++regularised_;
      system.matrix.diagonal().array() += 1e-9 * system.matrix.cwiseAbs().maxCoeff();
      lu.compute(system.matrix);
    }
    const Vector solved = lu.solve(system.right_side);
    if (!solved.allFinite()) {
      result_.reason = text("the derivative of iteration ", result_.iterations, " is singular");
      return false;
    }
    map_.take(system, solved, lambda_, alpha_);
    return true;
  }

  /// The row of history; true at the end.
  bool record(const NaturalMap::Value& before) {
    const NaturalMap::Value after = map_.at(lambda_, alpha_);
    IterationInfo info;
    info.iteration = result_.iterations;
    info.active = after.active;
    info.stick = after.stick;
    info.slip = after.slip;
    info.changed = after.differences(before);
    const double scale = std::max(lambda_.norm(), 1e-300);
    info.residual = after.norm / scale;
    info.seconds = watch_.seconds();
    result_.history.push_back(info);
    result_.active_sets.push_back(after.closed);
    monitor_.iteration(info);
    // On the right pieces a step of given friction in the plane is exact; others converge quadratically.
    result_.converged = info.residual <= settings_.tol;
    return result_.converged;
  }

  void finish() {
    if (result_.converged)
      result_.reason = "the residual fell below tol";
    else if (result_.reason.empty())
      result_.reason = monitor_.stop() ? "interrupted; this is the state so far"
                                       : text("no convergence within ", result_.iterations, " iterations");
    if (regularised_ > 0) result_.reason += text("; ", regularised_, " singular derivatives were regularised");
    if (!note_.empty()) result_.reason += "; " + note_;
    result_.slipping = map_.at(lambda_, alpha_).slipping;
  }

  static constexpr int kHalvings = 10;
  static constexpr std::size_t kMemory = 5;

  const Problem& problem_;
  const Newton& settings_;
  Monitor& monitor_;
  Result result_;
  const problem::RigidMotions rigid_;
  const std::string note_;
  CondensedProblem condensed_;
  NaturalMap map_;
  Vector lambda_, alpha_;
  std::vector<double> norms_;  ///< of F, the last few
  int regularised_ = 0;
  Stopwatch watch_;
};

}  // namespace

Result solve(const Problem& problem, const Newton& settings, Monitor& monitor) {
  return Iteration(problem, settings, monitor).run();
}

}  // namespace dotyk::solver
