#include "program/augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/direct/indefinite.hpp"
#include "base/error.hpp"
#include "base/moderate.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/scaling.hpp"

namespace dotyk::program {
namespace {

constexpr int kRestarts = 20;  ///< of CG with a freshly computed gradient, before rounding is blamed

class Iteration {
 public:
  Iteration(const QuadraticProgram& p, const AugmentedLagrangian& settings, Monitor& monitor)
      : p_(p), s_(settings), monitor_(monitor), x_(Vector::Zero(p.unknowns())), mu_(Vector::Zero(p.rows())), gap_(-p.low),
        rho_(settings.rho), eta_(settings.eta), size_(p.q.norm() > 0 ? p.q.norm() : 1) {
    if (settings.update == AugmentedLagrangian::Update::least_squares && p.rows() > 0) prepare_least_squares();
  }

  Result run() {
    result_.reason = text("no end within ", s_.max_iterations, " outer iterations");
    for (int k = 0; k < s_.max_iterations; ++k) {
      const bool precise = inner();
      result_.iterations = k + 1;
      const bool optimal = gradient().norm() <= s_.gradient_tol * size_ && gap_.norm() <= s_.feasibility_tol;
      const Vector exact = mu_ + rho_ * gap_;  // makes the gradient of the Lagrangian that of L
      monitor_.iteration({.iteration = k + 1, .changed = result_.cg, .residual = gap_.norm(), .seconds = clock_.seconds()});
      if (result_.status != Status::stopped) break;
      if (optimal) {
        result_.end(Status::solved, "gradient and feasibility are below their tolerances");
        mu_ = exact;
        break;
      }
      if (!precise) break;
      mu_ = s_.update == AugmentedLagrangian::Update::multiplier ? exact : least_squares();
      if (gap_.norm() <= eta_) eta_ *= s_.alpha;
      else rho_ *= s_.beta;
      if (monitor_.stop()) {
        result_.reason = "stopped on request";
        break;
      }
    }
    result_.penalty = rho_;
    result_.x = x_;
    result_.y = mu_;
    return result_;
  }

 private:
  /// (B + ρDᵀD) v.
  Vector times_L(const Vector& v) const { return times(p_.P, v) + rho_ * (p_.A.transpose() * (p_.A * v)); }
  Vector gradient() const {
    return times(p_.P, x_) + p_.q + p_.A.transpose() * (mu_ + rho_ * gap_);
  }

  /// ‖∇L‖ ≤ M‖Dx − d‖, or the end of the whole iteration.
  bool precise(double gradient_norm) const {
    const double gap = gap_.norm();
    return gradient_norm <= s_.M * gap || (gradient_norm <= s_.gradient_tol * size_ && gap <= s_.feasibility_tol);
  }

  /// CG from x until it is precise enough; false where it cannot be.
  bool inner() {
    for (int restart = 0; restart <= kRestarts; ++restart) {
      Vector r = -gradient();
      if (precise(r.norm())) return true;
      Vector v = r;
      double rr = r.squaredNorm();
      const double begun = rr;
      do {
        if (result_.cg >= s_.max_cg) {
          result_.reason = text("no end within ", s_.max_cg, " CG iterations");
          return false;
        }
        const Vector Lv = times_L(v);
        const double curvature = v.dot(Lv), flat = 1e-15 * v.norm() * (times(p_.P, v).norm() + v.norm());
        if (curvature <= flat) return stop_flat(v, curvature);
        const double step = rr / curvature;
        x_ += step * v;
        gap_ += step * (p_.A * v);
        r -= step * Lv;
        const double rr_new = r.squaredNorm();
        v = r + rr_new / rr * v;
        rr = rr_new;
        ++result_.cg;
      } while (!precise(std::sqrt(rr)) && rr > 1e-32 * begun);
    }
    result_.reason = "rounding keeps the inner iteration from its precision: a smaller penalty, or a larger M, is needed";
    return false;
  }

  bool stop_flat(const Vector& v, double curvature) {
    const bool negative = curvature < -1e-12 * v.squaredNorm();
    if (negative) result_.end(Status::not_convex, "CG met negative curvature", v.normalized());
    else result_.end(Status::unbounded, "the objective falls for ever along a direction of no curvature", v.normalized());
    return false;
  }

  void prepare_least_squares() {
    const SparseMatrix D = p_.A;
    const SparseMatrix product = D * SparseMatrix(D.transpose());
    const SparseMatrix lower = product.triangularView<Eigen::Lower>();
    gram_.emplace(lower);
    if (!gram_->factor(lower) || gram_->negative_pivots() > 0)
      throw InputError("the rows of D depend on one another: the least-squares update needs them independent");
  }
  Vector least_squares() const {
    if (p_.rows() == 0) return mu_;
    return -gram_->solve(p_.A * (times(p_.P, x_) + p_.q));
  }

  const QuadraticProgram& p_;
  const AugmentedLagrangian& s_;
  Monitor& monitor_;
  Stopwatch clock_;
  Vector x_, mu_;
  Vector gap_;  ///< Dx − d, carried along: computed from x it loses the digits that a large ρ brings out
  double rho_, eta_, size_;
  std::optional<algebra::QuasiDefinite> gram_;
  Result result_;
};

/// Squares of what is larger or smaller leave the range of numbers, in the end.
void require_moderate(const char* what, double size) {
  constexpr double kMost = 1e100;
  if (!moderate(size, kMost))
    throw InputError(text("values beyond the range of numbers: the greatest entry of ", what, " is ", size, "; choose units in which it is moderate"));
}

}  // namespace

Result solve(const QuadraticProgram& program, const AugmentedLagrangian& settings, Monitor& monitor) {
  check(program);
  for (int r = 0; r < program.rows(); ++r)
    if (!program.equality(r))
      throw InputError(text("row ", r + 1, " is an inequality; augmented Lagrangians take equalities only (use "
                            "\"active_set\" or \"interior_point\")"));
  require_moderate("B", peak(program.P));
  require_moderate("c", peak(program.q));
  require_moderate("D", peak(program.A));
  require_moderate("d", peak(program.low));
  Stopwatch clock;
  const double size = objective_unit(program);
  QuadraticProgram scaled = program;
  scaled.P /= size, scaled.q /= size, scaled.r /= size;
  Result result = Iteration(scaled, settings, monitor).run();
  result.y *= size;
  result.penalty *= size;
  measure(program, result);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace dotyk::program
