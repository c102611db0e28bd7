#include "solver/active/box_barrier.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

BoxProgram box_program(const problem::Problem& problem, const problem::CondensedProblem& condensed, const std::vector<int>& rows,
                       const std::vector<double>& stands_for) {
  const auto groups = problem.group_of_rows();
  const int n = static_cast<int>(rows.size());
  BoxProgram p{DenseMatrix(n, n), Vector(n), Vector(n), Vector(n), DenseMatrix(n, condensed.kernel_size()), condensed.e()};
  for (int j = 0; j < n; ++j) {
    const int r = rows[j], k = r - groups[r]->first;
    const double f = stands_for[r];
    for (int i = 0; i < n; ++i) p.H(i, j) = condensed.W()(rows[i], r);
    const problem::Springs springs = groups[r]->law->springs(k).value();
    const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
    p.H(j, j) += (compliance(springs.below) + compliance(springs.above)) / 2 / f;
    const problem::Interval bounds = groups[r]->law->multipliers(k);
    p.g[j] = condensed.x0()[r];
    p.low[j] = f * bounds.low;
    p.high[j] = f * bounds.high;
    p.N.row(j) = condensed.N().row(r);
  }
  return p;
}

namespace {

constexpr int kMostBarrierSteps = 80;
constexpr double kUndecidedBound = 1e-8;  ///< of the tolerance: bounds that are undecided there touch without pressing

/// The scaled program, without rows that have one multiplier only.
class Barrier {
 public:
  Barrier(const BoxProgram& program, double tol) : whole_(program), tol_(tol) {
    for (int i = 0; i < program.g.size(); ++i)
      if (program.low[i] < program.high[i]) rows_.push_back(i);
    scale();
  }

  BoxSolution operator()() {
    BoxSolution out;
    start();
    while (out.iterations < kMostBarrierSteps && step()) {
      ++out.iterations;
      if (error() > tol_) {
        if (out.converged) break;  // rounding has taken over
        continue;
      }
      out.converged = true;
      if (decided() || gap_at(x_, z_low_, z_high_) <= kUndecidedBound * tol_) break;
    }
    out.lambda = whole_.low;
    out.alpha = alpha_.cwiseProduct(motion_unit_);
    out.side.assign(whole_.g.size(), 0);
    for (int k = 0; k < size(); ++k) {
      const int i = rows_[k];
      out.lambda[i] = std::clamp(x_[k] * unit_[k] * force_, whole_.low[i], whole_.high[i]);
      if (bounded_below(k) && slower(z_low_[k], before_.z_low[k], x_[k] - low_[k], before_.x[k] - low_[k])) out.side[i] = -1;
      else if (bounded_above(k) && slower(z_high_[k], before_.z_high[k], high_[k] - x_[k], high_[k] - before_.x[k])) out.side[i] = 1;
    }
    return out;
  }

 private:
  int size() const { return static_cast<int>(rows_.size()); }

  void scale() {
    const int n = size(), m = static_cast<int>(whole_.N.cols());
    const double greatest = n > 0 ? whole_.H.diagonal().maxCoeff() : 1;
    unit_.resize(n), H_.resize(n, n), g_.resize(n), low_.resize(n), high_.resize(n), N_.resize(n, m);
    Vector fixed = Vector::Zero(whole_.g.size());
    for (int i = 0; i < fixed.size(); ++i)
      if (whole_.low[i] >= whole_.high[i]) fixed[i] = whole_.low[i];
    const Vector g = whole_.g - whole_.H * fixed;
    e_ = whole_.e - whole_.N.transpose() * fixed;
    for (int k = 0; k < n; ++k) unit_[k] = 1 / std::sqrt(std::max(whole_.H(rows_[k], rows_[k]), 1e-14 * greatest));
    for (int k = 0; k < n; ++k) g_[k] = unit_[k] * g[rows_[k]];
    force_ = n > 0 ? g_.lpNorm<Eigen::Infinity>() : 1;
    if (m > 0) force_ = std::max(force_, e_.lpNorm<Eigen::Infinity>() / std::max(1e-300, (unit_.asDiagonal() * pick(whole_.N)).cwiseAbs().maxCoeff()));
    if (!(force_ > 0)) force_ = 1;
    g_ /= force_;
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) H_(j, k) = unit_[j] * whole_.H(rows_[j], rows_[k]) * unit_[k];
      low_[k] = whole_.low[rows_[k]] / (unit_[k] * force_);
      high_[k] = whole_.high[rows_[k]] / (unit_[k] * force_);
    }
    N_ = unit_.asDiagonal() * pick(whole_.N);
    e_ /= force_;
    motion_unit_ = Vector::Zero(m);
    for (int j = 0; j < m; ++j) {
      const double length = N_.col(j).norm();
      if (length == 0) continue;
      N_.col(j) /= length;
      motion_unit_[j] = force_ / length;
      e_[j] /= length;
    }
  }

  DenseMatrix pick(const DenseMatrix& from) const {
    DenseMatrix out(size(), from.cols());
    for (int k = 0; k < size(); ++k) out.row(k) = from.row(rows_[k]);
    return out;
  }

  bool bounded_below(int k) const { return std::isfinite(low_[k]); }
  bool bounded_above(int k) const { return std::isfinite(high_[k]); }

  void start() {
    const int n = size();
    x_ = Vector::Zero(n), z_low_ = Vector::Zero(n), z_high_ = Vector::Zero(n), alpha_ = Vector::Zero(N_.cols());
    for (int k = 0; k < n; ++k) {
      if (bounded_below(k) && bounded_above(k)) x_[k] = std::clamp(0.0, std::min(low_[k] + 1, middle(k)), std::max(high_[k] - 1, middle(k)));
      else if (bounded_below(k)) x_[k] = low_[k] + 1;
      else if (bounded_above(k)) x_[k] = high_[k] - 1;
      z_low_[k] = bounded_below(k), z_high_[k] = bounded_above(k);
    }
    before_ = {x_, z_low_, z_high_, {}};
  }

  double middle(int k) const { return (low_[k] + high_[k]) / 2; }
  int bounds() const {
    int count = 0;
    for (int k = 0; k < size(); ++k) count += bounded_below(k) + bounded_above(k);
    return std::max(count, 1);
  }
  double gap_at(const Vector& x, const Vector& z_low, const Vector& z_high) const {
    double sum = 0;
    for (int k = 0; k < size(); ++k) {
      if (bounded_below(k)) sum += z_low[k] * (x[k] - low_[k]);
      if (bounded_above(k)) sum += z_high[k] * (high_[k] - x[k]);
    }
    return sum / bounds();
  }
  Vector stationarity() const { return g_ - H_ * x_ + N_ * alpha_ + z_low_ - z_high_; }
  double error() const {
    const double dual = size() ? stationarity().lpNorm<Eigen::Infinity>() : 0, primal = e_.size() ? (e_ - N_.transpose() * x_).lpNorm<Eigen::Infinity>() : 0;
    return std::max({dual, primal, gap_at(x_, z_low_, z_high_)});
  }

  struct Direction {
    Vector x, z_low, z_high, alpha;
  };

  /// Has z fallen by less than the distance to its bound in the last step, whatever their units?
  static bool slower(double z, double z_before, double distance, double distance_before) { return z * distance_before > distance * z_before; }

  /// Has one of the two ceased to fall at every bound, while the other falls on?
  bool decided() const {
    const auto clear = [](double a, double b) { return std::min(a, b) < kFalls * std::max(a, b) && std::max(a, b) > kStays; };
    for (int k = 0; k < size(); ++k) {
      if (bounded_below(k) && !clear((x_[k] - low_[k]) / (before_.x[k] - low_[k]), z_low_[k] / before_.z_low[k])) return false;
      if (bounded_above(k) && !clear((high_[k] - x_[k]) / (high_[k] - before_.x[k]), z_high_[k] / before_.z_high[k])) return false;
    }
    return true;
  }

  bool factor() {
    M_ = H_;
    for (int k = 0; k < size(); ++k) {
      if (bounded_below(k)) M_(k, k) += z_low_[k] / (x_[k] - low_[k]);
      if (bounded_above(k)) M_(k, k) += z_high_[k] / (high_[k] - x_[k]);
      M_(k, k) += 1e-14;
    }
    if (!algebra::cholesky(M_)) return false;
    Y_ = N_;
    if (Y_.cols() == 0) return true;
    algebra::solve_lower(M_, Y_);
    schur_.emplace(algebra::gram(Y_));
    return true;
  }

  /// Newton's step to complementarity `target`, with the predictor's products taken off.
  Direction direction(double target, const Direction* predictor) const {
    const int n = size();
    Vector low_target = Vector::Zero(n), high_target = Vector::Zero(n);
    for (int k = 0; k < n; ++k) {
      if (bounded_below(k)) low_target[k] = target - (predictor ? predictor->x[k] * predictor->z_low[k] : 0);
      if (bounded_above(k)) high_target[k] = target + (predictor ? predictor->x[k] * predictor->z_high[k] : 0);
    }
    DenseMatrix r = stationarity();
    for (int k = 0; k < n; ++k) {
      if (bounded_below(k)) r(k, 0) += low_target[k] / (x_[k] - low_[k]) - z_low_[k];
      if (bounded_above(k)) r(k, 0) -= high_target[k] / (high_[k] - x_[k]) - z_high_[k];
    }
    Direction d;
    algebra::solve_lower(M_, r);
    d.alpha = Vector::Zero(N_.cols());
    if (N_.cols() > 0) {
      d.alpha = schur_->solve(Vector(e_ - N_.transpose() * x_ - Y_.transpose() * r));
      r += Y_ * d.alpha;
    }
    algebra::solve_lower_transposed(M_, r);
    d.x = r;
    d.z_low = Vector::Zero(n), d.z_high = Vector::Zero(n);
    for (int k = 0; k < n; ++k) {
      if (bounded_below(k)) d.z_low[k] = (low_target[k] - z_low_[k] * d.x[k]) / (x_[k] - low_[k]) - z_low_[k];
      if (bounded_above(k)) d.z_high[k] = (high_target[k] + z_high_[k] * d.x[k]) / (high_[k] - x_[k]) - z_high_[k];
    }
    return d;
  }

  double length(const Direction& d) const {
    double step = 1;
    const auto limit = [&](double value, double change) {
      if (change < 0) step = std::min(step, -value / change);
    };
    for (int k = 0; k < size(); ++k) {
      if (bounded_below(k)) limit(x_[k] - low_[k], d.x[k]), limit(z_low_[k], d.z_low[k]);
      if (bounded_above(k)) limit(high_[k] - x_[k], -d.x[k]), limit(z_high_[k], d.z_high[k]);
    }
    return step;
  }

  bool step() {
    if (!factor()) return false;
    const double gap = gap_at(x_, z_low_, z_high_);
    const Direction predictor = direction(0, nullptr);
    if (!predictor.x.allFinite()) return false;
    const double reach = length(predictor);
    const double after = gap_at(x_ + reach * predictor.x, z_low_ + reach * predictor.z_low, z_high_ + reach * predictor.z_high);
    const double centring = std::pow(std::max(after, 0.0) / std::max(gap, 1e-300), 3);
    const Direction d = direction(centring * gap, &predictor);
    if (!d.x.allFinite()) return false;
    const double t = std::min(1.0, kBack * length(d));
    before_ = {x_, z_low_, z_high_, {}};
    x_ += t * d.x, z_low_ += t * d.z_low, z_high_ += t * d.z_high, alpha_ += t * d.alpha;
    return true;
  }

  const BoxProgram& whole_;
  double tol_, force_ = 1;
  std::vector<int> rows_;
  Vector motion_unit_;
  Vector unit_;                     ///< of each multiplier, so that H has a diagonal of 1
  DenseMatrix H_, N_, M_, Y_;
  Vector g_, low_, high_, e_;
  Vector x_, z_low_, z_high_, alpha_;
  Direction before_;  ///< where the last step began
  std::optional<algebra::MinimumNorm> schur_;
};

}  // namespace

BoxSolution solve_by_barrier(const BoxProgram& program, double tol) { return Barrier(program, tol)(); }

}  // namespace dotyk::solver
