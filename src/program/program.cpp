#include "program/program.hpp"

#include <cmath>

#include "algebra/direct/indefinite.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::program {

void check(const QuadraticProgram& p) {
  const int n = p.unknowns(), m = p.rows();
  if (n == 0) throw InputError("the program has no unknowns");
  if (p.P.rows() != n || p.P.cols() != n)
    throw InputError(text("the quadratic matrix is ", p.P.rows(), "x", p.P.cols(), "; the linear term has ", n, " entries"));
  if (p.A.rows() != m || p.high.size() != m || (m > 0 && p.A.cols() != n))
    throw InputError(text("the constraint matrix is ", p.A.rows(), "x", p.A.cols(), "; it must have ", n,
                          " columns and one row for each of the ", m, " lower and ", p.high.size(), " upper limits"));
  if (!p.q.allFinite()) throw InputError("the linear term holds nan or inf");
  const auto finite = [](const auto& matrix) {
    return Eigen::Map<const Vector>(matrix.valuePtr(), matrix.nonZeros()).allFinite();
  };
  if (!finite(p.P)) throw InputError("the quadratic matrix holds nan or inf");
  if (!finite(p.A)) throw InputError("the constraint matrix holds nan or inf");
  for (int r = 0; r < m; ++r) {
    if (std::isnan(p.low[r]) || std::isnan(p.high[r])) throw InputError(text("row ", r + 1, " has nan as a limit"));
    if (p.low[r] > p.high[r])
      throw InputError(text("row ", r + 1, " has low = ", p.low[r], " above high = ", p.high[r]));
    if (p.low[r] == INFINITY || p.high[r] == -INFINITY)
      throw InputError(text("row ", r + 1, " allows nothing: low = ", p.low[r], ", high = ", p.high[r]));
  }
}

Vector times(const SparseMatrix& lower, const Vector& x) {
  return lower.selfadjointView<Eigen::Lower>() * x;
}

double objective(const QuadraticProgram& p, const Vector& x) {
  return 0.5 * x.dot(times(p.P, x)) + p.q.dot(x) + p.r;
}

namespace {

/// Σ_j A_rj²/P_jj of each row, those j left out that nothing holds: how far a unit of its force moves it, or less.
Vector row_compliance(const QuadraticProgram& p) {
  const Vector stiffness = p.P.diagonal();
  Vector compliance = Vector::Zero(p.rows());
  for (int r = 0; r < p.rows(); ++r)
    for (SparseRows::InnerIterator it(p.A, r); it; ++it)
      if (stiffness[it.col()] > 0) compliance[r] += it.value() * it.value() / stiffness[it.col()];
  return compliance;
}

}  // namespace

Residuals residuals(const QuadraticProgram& p, const Vector& x, const Vector& y) {
  Residuals out;
  const Vector Px = times(p.P, x), Ay = p.A.transpose() * y, Ax = p.A * x;
  const Vector size = p.A.cwiseAbs() * x.cwiseAbs();
  const SparseMatrix sizes = p.P.cwiseAbs();
  out.stationarity_scale = std::max({peak(times(sizes, x.cwiseAbs())), peak(p.q), peak(p.A.cwiseAbs().transpose() * y.cwiseAbs())});
  out.stationarity = peak(Px + p.q + Ay);
  double limits = 0, complementary = x.dot(Px) + p.q.dot(x);
  for (int r = 0; r < p.rows(); ++r) {
    const double below = p.low[r] - Ax[r], above = Ax[r] - p.high[r];
    out.feasibility = std::max({out.feasibility, below, above});
    if (below > 0) limits = std::max(limits, std::abs(p.low[r]));
    if (above > 0) limits = std::max(limits, std::abs(p.high[r]));
    // A multiplier of the wrong kind of row counts through its product with the activity.
    if (y[r] != 0) {
      const double limit = y[r] > 0 ? p.high[r] : p.low[r];
      complementary += y[r] * (std::isfinite(limit) ? limit : Ax[r] + (y[r] > 0 ? 1 : -1) * (1 + std::abs(Ax[r])));
    }
  }
  out.feasibility_scale = std::max({peak(size), limits, 1e-6 * peak(y.cwiseProduct(row_compliance(p)))});
  out.complementarity = std::abs(complementary);
  out.complementarity_scale = 1 + std::abs(objective(p, x));
  if (out.stationarity > 0) out.stationarity /= out.stationarity_scale;
  if (out.feasibility > 0) out.feasibility /= out.feasibility_scale;
  out.complementarity /= out.complementarity_scale;
  if (std::isnan(out.complementarity)) out.complementarity = INFINITY;  // both overflow: nothing is known of it
  return out;
}

const char* text_of(Status status) {
  constexpr const char* kNames[] = {"solved", "infeasible", "unbounded", "not_convex", "stopped"};
  return kNames[static_cast<int>(status)];
}

void measure(const QuadraticProgram& program, Result& result) {
  result.objective = objective(program, result.x);
  const Residuals& r = result.residual = residuals(program, result.x, result.y);
  const double sum = result.objective + r.stationarity + r.feasibility + r.complementarity + r.stationarity_scale +
                     r.feasibility_scale + r.complementarity_scale;
  if (result.status != Status::solved || (result.x.allFinite() && result.y.allFinite() && std::isfinite(sum))) return;
  result.end(Status::stopped, "values beyond the range of numbers: what was found cannot be measured; choose units in which the numbers are moderate");
}

Vector negative_curvature(const SparseMatrix& lower, double tolerance) {
  const double largest = peak(lower);
  if (largest == 0) return {};
  SparseMatrix shifted = lower, unit(lower.rows(), lower.cols());
  unit.setIdentity();
  shifted += 2 * tolerance * largest * unit;
  algebra::QuasiDefinite factor(shifted);
  if (factor.factor(shifted) && factor.negative_pivots() == 0) return {};
  const Vector v = factor.negative_direction();
  return v.size() && v.dot(times(lower, v)) < -tolerance * largest * v.squaredNorm() ? Vector(v.normalized()) : Vector{};
}

}  // namespace dotyk::program
