#include "solver/active/interior_start.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/generalised_inverse.hpp"
#include "solver/active/box_barrier.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;

namespace {

constexpr int kMostInteriorSteps = 40;
constexpr double kBalancedResidual = 1e-6;  ///< enough of residuals, of which rounding leaves more than of the gap μ
constexpr double kUndecidedRow = 1e-12;  ///< of the gap asked for: rows that are undecided there touch without force
constexpr double kNever = 1e6;  ///< so many displacements away a row never closes
constexpr double kRigid = 1e-10;  ///< D of rigid rows, of the compliance that the body has there

class Interior {
 public:
  Interior(const Problem& problem, const problem::RigidMotions& rigid, HeldStiffness& stiffness, double tol, Monitor& monitor)
      : problem_(problem), stiffness_(stiffness), tol_(tol), monitor_(monitor), f_(problem.unknowns()), own_(problem.row_stiffness()) {
    for (const problem::Block& block : problem.blocks) f_.segment(block.first, block.size()) = block.f;
    take_laws();
    scale(rigid);
  }

  InteriorPointState operator()() {
    InteriorPointState out;
    if (!(force_ > 0 && length_ > 0)) return out;
    start();
    while (out.iterations < kMostInteriorSteps && !done() && !monitor_.stop() && step()) ++out.iterations;
    round(out);
    return out;
  }

 private:
  int rows() const { return problem_.rows(); }

  void take_laws() {
    low_ = high_ = below_ = above_ = Vector::Zero(rows());
    const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
    for (const problem::RowGroup& group : problem_.groups)
      for (int k = 0; k < group.count; ++k) {
        const int r = group.first + k;
        const problem::Interval bounds = group.law->multipliers(k);
        const problem::Springs springs = group.law->springs(k).value();
        low_[r] = bounds.low, high_[r] = bounds.high;
        below_[r] = compliance(springs.below), above_[r] = compliance(springs.above);
      }
  }

  /// Of the body as it bends where as few unknowns hold it as can: under its load, and under a force on each row that would move it by what rows are off.
  void scale(const problem::RigidMotions& rigid) {
    std::vector<char> held(problem_.unknowns(), 0);
    for (const int unknown : algebra::fixing_unknowns(algebra::SparseMatrix(stiffness_.basis().of_displacements(problem_) * problem::displacement(problem_, rigid.noticed)))) held[unknown] = 1;
    if (rows() == 0 || !stiffness_.factor(Vector::Zero(rows()), held)) return;
    const auto moved = [&](const Vector& f) { return (problem_.B * stiffness_.solve(f)).lpNorm<Eigen::Infinity>(); };
    const double bent = moved(f_), compliance = moved(problem_.B.transpose() * Vector::Ones(rows()));
    const double pressed = std::max(0.0, -problem_.c.minCoeff());
    length_ = std::max(bent, pressed);
    for (int r = 0; r < rows(); ++r) {
      if (problem_.c[r] < kNever * length_) length_ = std::max(length_, problem_.c[r]);
      else if (std::isfinite(low_[r])) high_[r] = low_[r];
    }
    force_ = std::max(f_.lpNorm<1>() / rows(), compliance > 0 ? pressed / compliance : 0);
  }

  bool fixed(int r) const { return low_[r] >= high_[r]; }
  bool bounded_below(int r) const { return std::isfinite(low_[r]) && !fixed(r); }
  bool bounded_above(int r) const { return std::isfinite(high_[r]) && !fixed(r); }
  double compliance(int r) const { return lambda_[r] < 0 ? below_[r] : above_[r]; }

  void start() {
    u_ = Vector::Zero(problem_.unknowns());
    lambda_ = z_low_ = z_high_ = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      if (fixed(r)) lambda_[r] = low_[r];
      else if (bounded_below(r) && bounded_above(r)) lambda_[r] = (low_[r] + high_[r]) / 2;
      else if (bounded_below(r)) lambda_[r] = low_[r] + force_;
      else if (bounded_above(r)) lambda_[r] = high_[r] - force_;
      if (bounded_below(r)) z_low_[r] = length_;
      if (bounded_above(r)) z_high_[r] = length_;
    }
    before_ = {lambda_, z_low_, z_high_};
  }

  struct Direction {
    Vector u, lambda, z_low, z_high;
  };

  double gap_at(const Vector& z_low, const Vector& z_high, const Vector& lambda) const {
    double sum = 0;
    int count = 0;
    for (int r = 0; r < rows(); ++r) {
      if (bounded_below(r)) sum += z_low[r] * (lambda[r] - low_[r]), ++count;
      if (bounded_above(r)) sum += z_high[r] * (high_[r] - lambda[r]), ++count;
    }
    return sum / std::max(count, 1);
  }

  bool done() const {
    const double gap = gap_at(z_low_, z_high_, lambda_) / (force_ * length_);
    return gap <= tol_ && (off() <= kBalancedResidual || gap <= kBalancedResidual * tol_) && (decided() || gap <= kUndecidedRow * tol_);
  }
  /// Has one of λ − low and z⁻ (likewise above) ceased to fall in every row, while the other falls on?
  bool decided() const {
    const auto clear = [](double a, double b) { return std::min(a, b) < kFalls * std::max(a, b) && std::max(a, b) > kStays; };
    for (int r = 0; r < rows(); ++r) {
      if (bounded_below(r) && !clear((lambda_[r] - low_[r]) / (before_.lambda[r] - low_[r]), z_low_[r] / before_.z_low[r])) return false;
      if (bounded_above(r) && !clear((high_[r] - lambda_[r]) / (high_[r] - before_.lambda[r]), z_high_[r] / before_.z_high[r])) return false;
    }
    return true;
  }
  Vector equilibrium() const { return f_ - problem::stiffness_times(problem_, u_) - problem_.B.transpose() * lambda_; }
  Vector compatibility() const {
    Vector off = problem_.c + z_high_ - z_low_ - problem_.B * u_;
    for (int r = 0; r < rows(); ++r) off[r] = fixed(r) ? 0 : off[r] + compliance(r) * lambda_[r];
    return off;
  }
  double off() const {
    return std::max(equilibrium().lpNorm<1>() / (force_ * rows()), compatibility().lpNorm<Eigen::Infinity>() / length_);
  }

  /// D⁻¹
  Vector springs() const {
    Vector s = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      if (fixed(r)) continue;
      double D = compliance(r);
      if (bounded_below(r)) D += z_low_[r] / (lambda_[r] - low_[r]);
      if (bounded_above(r)) D += z_high_[r] / (high_[r] - lambda_[r]);
      s[r] = 1 / std::max(D, own_[r] > 0 ? kRigid / own_[r] : 1e-300);
    }
    return s;
  }

  /// Newton's step to complementarity `target`, with the predictor's products taken off.
  Direction direction(const Vector& s, double target, const Direction* predictor) const {
    Vector q = compatibility(), low_target = Vector::Zero(rows()), high_target = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      if (bounded_below(r)) {
        low_target[r] = target - z_low_[r] * (lambda_[r] - low_[r]) - (predictor ? predictor->lambda[r] * predictor->z_low[r] : 0);
        q[r] -= low_target[r] / (lambda_[r] - low_[r]);
      }
      if (bounded_above(r)) {
        high_target[r] = target - z_high_[r] * (high_[r] - lambda_[r]) + (predictor ? predictor->lambda[r] * predictor->z_high[r] : 0);
        q[r] += high_target[r] / (high_[r] - lambda_[r]);
      }
    }
    Direction d;
    d.u = stiffness_.solve(equilibrium() + problem_.B.transpose() * s.cwiseProduct(q));
    d.lambda = s.cwiseProduct(problem_.B * d.u - q);
    d.z_low = d.z_high = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      if (bounded_below(r)) d.z_low[r] = (low_target[r] - z_low_[r] * d.lambda[r]) / (lambda_[r] - low_[r]);
      if (bounded_above(r)) d.z_high[r] = (high_target[r] + z_high_[r] * d.lambda[r]) / (high_[r] - lambda_[r]);
    }
    return d;
  }

  double reach(const Direction& d) const {
    double step = 1 / kBack;
    const auto limit = [&](double value, double change) {
      if (change < 0) step = std::min(step, -value / change);
    };
    for (int r = 0; r < rows(); ++r) {
      if (bounded_below(r)) limit(lambda_[r] - low_[r], d.lambda[r]), limit(z_low_[r], d.z_low[r]);
      if (bounded_above(r)) limit(high_[r] - lambda_[r], -d.lambda[r]), limit(z_high_[r], d.z_high[r]);
    }
    return kBack * step;
  }

  bool step() {
    const Vector s = springs();
    if (!stiffness_.factor(s, std::vector<char>(problem_.unknowns(), 0))) return false;
    const double gap = gap_at(z_low_, z_high_, lambda_);
    const Direction predictor = direction(s, 0, nullptr);
    if (!predictor.lambda.allFinite()) return false;
    const double t = reach(predictor);
    const double after = gap_at(z_low_ + t * predictor.z_low, z_high_ + t * predictor.z_high, lambda_ + t * predictor.lambda);
    const double centring = gap > 0 ? std::pow(std::max(after, 0.0) / gap, 3) : 0;
    const Direction d = direction(s, centring * gap, &predictor);
    if (!d.lambda.allFinite() || !d.u.allFinite()) return false;
    const double step = reach(d);
    before_ = {lambda_, z_low_, z_high_};
    u_ += step * d.u, lambda_ += step * d.lambda, z_low_ += step * d.z_low, z_high_ += step * d.z_high;
    return true;
  }

  /// Onto the laws: of λ − low and z⁻ (likewise above) the one that fell by more in the last step goes to zero, whatever their units.
  void round(InteriorPointState& out) const {
    out.lambda = lambda_;
    out.x = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      const bool at_low = bounded_below(r) && z_low_[r] * (before_.lambda[r] - low_[r]) > (lambda_[r] - low_[r]) * before_.z_low[r];
      const bool at_high = bounded_above(r) && z_high_[r] * (high_[r] - before_.lambda[r]) > (high_[r] - lambda_[r]) * before_.z_high[r];
      if (at_low) out.lambda[r] = low_[r];
      if (at_high) out.lambda[r] = high_[r];
      out.x[r] = compliance(r) * out.lambda[r] + (at_high ? z_high_[r] : 0) - (at_low ? z_low_[r] : 0);
    }
  }

  const Problem& problem_;
  HeldStiffness& stiffness_;
  double tol_;
  Monitor& monitor_;
  Vector f_, low_, high_;
  Vector below_, above_;  ///< 1/k where λ < 0 and where λ > 0
  const Vector own_;
  double force_ = 0, length_ = 0;  ///< scales of a row's multiplier and of displacements; 0: neither loaded nor pressed
  Vector u_, lambda_, z_low_, z_high_;
  struct {
    Vector lambda, z_low, z_high;
  } before_;
};

}  // namespace

InteriorPointState interior_start(const Problem& problem, const problem::RigidMotions& rigid, HeldStiffness& stiffness, double tol, Monitor& monitor) {
  return Interior(problem, rigid, stiffness, tol, monitor)();
}

}  // namespace dotyk::solver
