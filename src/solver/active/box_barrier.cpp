#include "solver/active/box_barrier.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "program/barrier.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

BoxProgram box_program(const problem::Problem& problem, const problem::CondensedProblem& condensed, const problem::Measure& measure,
                       const std::vector<int>& rows, const std::vector<double>& stands_for) {
  const auto groups = problem.group_of_rows();
  const int n = static_cast<int>(rows.size());
  BoxProgram p{condensed.W()(rows, rows), condensed.x0()(rows), Vector(n), Vector(n), condensed.N()(rows, Eigen::all), condensed.e(),
               measure.stiffness()(rows).cwiseSqrt(), 0};
  for (int j = 0; j < n; ++j) {
    const int r = rows[j], k = r - groups[r]->first;
    const double f = stands_for[r];
    const problem::Springs springs = groups[r]->law->springs(k).value();
    const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
    p.H(j, j) += (compliance(springs.below) + compliance(springs.above)) / 2 / f;
    const problem::Interval bounds = groups[r]->law->multipliers(k);
    p.low[j] = f * bounds.low;
    p.high[j] = f * bounds.high;
    p.energy = std::max(p.energy, std::pow(measure.force_of_row(r) / p.unit[j], 2));
  }
  p.unit *= std::sqrt(p.energy);
  return p;
}

namespace {

constexpr int kMostBarrierSteps = 80;
constexpr double kUndecidedBound = 1e-8;  ///< of the tolerance: bounds that are undecided there touch without pressing

/// Without dimension, on these rows; the others keep their multipliers `fixed`. α is in units of E over the greatest unit of force.
BoxProgram scaled(const BoxProgram& p, const std::vector<int>& rows, const Vector& fixed) {
  const Vector unit = p.unit(rows), ones = Vector::Ones(unit.size());
  const double force = p.unit.maxCoeff();
  return {unit.asDiagonal() * p.H(rows, rows) * unit.asDiagonal() / p.energy, unit.cwiseProduct((p.g - p.H * fixed)(rows)) / p.energy,
          p.low(rows).cwiseQuotient(unit), p.high(rows).cwiseQuotient(unit), unit.asDiagonal() * p.N(rows, Eigen::all) / force,
          (p.e - p.N.transpose() * fixed) / force, ones, 1};
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
  std::vector<int> rows;
  BoxSolution out{program.low, Vector::Zero(program.N.cols()), std::vector<signed char>(program.g.size(), 0)};
  for (int i = 0; i < program.g.size(); ++i)
    if (program.low[i] < program.high[i]) rows.push_back(i), out.lambda[i] = 0;
  if (program.g.size() == 0) return out;
  const BoxProgram without = scaled(program, rows, out.lambda);
  BoxBarrier barrier(without);
  for (barrier.evaluate(); out.iterations < kMostBarrierSteps && barrier.step(); ++out.iterations) {
    barrier.evaluate();
    const bool within = barrier.error() <= tol;
    if (out.converged && !within) break;  // rounding has taken over
    out.converged = within;
    if (within && (barrier.decided() || barrier.gap() <= kUndecidedBound * tol)) break;
  }
  out.alpha = barrier.point().x * program.energy / program.unit.maxCoeff();
  const auto ends = barrier.ends();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int i = rows[k];
    out.lambda[i] = std::clamp(program.unit[i] * barrier.point().w[static_cast<Eigen::Index>(k)], program.low[i], program.high[i]);
    out.side[i] = static_cast<signed char>(ends[k].side);
  }
  return out;
}

}  // namespace dotyk::solver
