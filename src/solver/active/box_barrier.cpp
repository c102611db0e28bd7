#include "solver/active/box_barrier.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "program/barrier.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

BoxProgram box_program(const problem::Problem& problem, const problem::CondensedProblem& condensed, const std::vector<int>& rows,
                       const std::vector<double>& stands_for) {
  const auto groups = problem.group_of_rows();
  const int n = static_cast<int>(rows.size());
  BoxProgram p{condensed.W()(rows, rows), condensed.x0()(rows), Vector(n), Vector(n), condensed.N()(rows, Eigen::all), condensed.e()};
  for (int j = 0; j < n; ++j) {
    const int r = rows[j], k = r - groups[r]->first;
    const double f = stands_for[r];
    const problem::Springs springs = groups[r]->law->springs(k).value();
    const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
    p.H(j, j) += (compliance(springs.below) + compliance(springs.above)) / 2 / f;
    const problem::Interval bounds = groups[r]->law->multipliers(k);
    p.low[j] = f * bounds.low;
    p.high[j] = f * bounds.high;
  }
  return p;
}

namespace {

constexpr int kMostBarrierSteps = 80;
constexpr double kUndecidedBound = 1e-8;  ///< of the tolerance: bounds that are undecided there touch without pressing

/// A program in units in which H has a diagonal of 1, g a greatest entry of 1 and columns of N are of length 1, without rows that have one
/// multiplier only.
struct ScaledBox {
  explicit ScaledBox(const BoxProgram& whole);
  int size() const { return static_cast<int>(rows.size()); }

  std::vector<int> rows;  ///< of the whole program
  double force = 1;
  Vector unit, motion_unit;  ///< of multipliers, besides `force`, and of motions
  BoxProgram program;
};

ScaledBox::ScaledBox(const BoxProgram& whole) {
  const int m = static_cast<int>(whole.N.cols());
  Vector fixed = Vector::Zero(whole.g.size());
  for (int i = 0; i < fixed.size(); ++i) {
    if (whole.low[i] < whole.high[i]) rows.push_back(i);
    else fixed[i] = whole.low[i];
  }
  const Vector diagonal = whole.H.diagonal(), g = whole.g - whole.H * fixed;
  unit = diagonal(rows).cwiseMax(1e-14 * (size() > 0 ? diagonal.maxCoeff() : 1)).cwiseSqrt().cwiseInverse();
  program = {unit.asDiagonal() * whole.H(rows, rows) * unit.asDiagonal(), unit.cwiseProduct(g(rows)), {}, {},
             unit.asDiagonal() * whole.N(rows, Eigen::all), whole.e - whole.N.transpose() * fixed};
  if (size() > 0) force = program.g.lpNorm<Eigen::Infinity>();
  if (m > 0) force = std::max(force, program.e.lpNorm<Eigen::Infinity>() / std::max(1e-300, program.N.lpNorm<Eigen::Infinity>()));
  if (!(force > 0)) force = 1;
  program.g /= force, program.e /= force;
  program.low = whole.low(rows).cwiseQuotient(unit * force);
  program.high = whole.high(rows).cwiseQuotient(unit * force);
  motion_unit = Vector::Zero(m);
  for (int j = 0; j < m; ++j) {
    const double length = program.N.col(j).norm();
    if (length == 0) continue;
    program.N.col(j) /= length;
    program.e[j] /= length;
    motion_unit[j] = force / length;
  }
}

/// w is λ, x is α.
class BoxBarrier final : public program::Barrier {
 public:
  explicit BoxBarrier(const BoxProgram& program) : Barrier(program.low, program.high), p_(program) {
    at_.x = Vector::Zero(p_.N.cols());
    place(Vector::Zero(rows()), 1, 1);
  }
  void evaluate() override {
    Barrier::evaluate();
    unbalanced_ = p_.e - p_.N.transpose() * at_.w;
    dual_ = p_.g - p_.H * at_.w + p_.N * at_.x - at_.y;
  }
  double error() const { return std::max({program::peak(dual_), program::peak(unbalanced_), gap()}); }

 private:
  bool factor(const Vector& theta) override {
    M_ = p_.H;
    M_.diagonal() += theta + Vector::Constant(rows(), 1e-14);
    if (!algebra::cholesky(M_)) return false;
    Y_ = p_.N;
    if (Y_.cols() == 0) return true;
    algebra::solve_lower(M_, Y_);
    schur_.emplace(algebra::gram(Y_));
    return true;
  }

  void solve(const Vector& kappa, Point& d) override {
    DenseMatrix r = dual_ - kappa;
    algebra::solve_lower(M_, r);
    d.x = Vector::Zero(p_.N.cols());
    if (d.x.size() > 0) {
      d.x = schur_->solve(Vector(unbalanced_ - Y_.transpose() * r));
      r += Y_ * d.x;
    }
    algebra::solve_lower_transposed(M_, r);
    d.w = r;
  }

  const BoxProgram& p_;
  Vector dual_, unbalanced_;
  DenseMatrix M_, Y_;
  std::optional<algebra::MinimumNorm> schur_;
};

}  // namespace

BoxSolution solve_by_barrier(const BoxProgram& program, double tol) {
  const ScaledBox scaled(program);
  BoxBarrier barrier(scaled.program);
  BoxSolution out;
  for (barrier.evaluate(); out.iterations < kMostBarrierSteps && barrier.step(); ++out.iterations) {
    barrier.evaluate();
    const bool within = barrier.error() <= tol;
    if (out.converged && !within) break;  // rounding has taken over
    out.converged = within;
    if (within && (barrier.decided() || barrier.gap() <= kUndecidedBound * tol)) break;
  }
  out.lambda = program.low;
  out.alpha = barrier.point().x.cwiseProduct(scaled.motion_unit);
  out.side.assign(program.g.size(), 0);
  const auto ends = barrier.ends();
  for (int k = 0; k < scaled.size(); ++k) {
    const int i = scaled.rows[k];
    out.lambda[i] = std::clamp(barrier.point().w[k] * scaled.unit[k] * scaled.force, program.low[i], program.high[i]);
    out.side[i] = static_cast<signed char>(ends[k].side);
  }
  return out;
}

}  // namespace dotyk::solver
