#include "program/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/moderate.hpp"

namespace dotyk::program {
namespace {

/// visit(row, column, value) of every entry, whose value it may change.
template <class Matrix, class Visit>
void visit_entries(Matrix& a, const Visit& visit) {
  for (Eigen::Index k = 0; k < a.outerSize(); ++k)
    for (typename Matrix::InnerIterator it(a, k); it; ++it) visit(it.row(), it.col(), it.valueRef());
}

/// Divides by the root of what is not zero.
void divide(Vector& factor, const Vector& largest) {
  for (int i = 0; i < factor.size(); ++i)
    if (largest[i] > 0) factor[i] /= std::sqrt(largest[i]);
}

}  // namespace

void Scaled::take_back(Result& result) const {
  result.x = x(result.x);
  result.y = y(result.y);
  if (result.status == Status::unbounded) result.direction = x(result.direction).normalized();
  if (result.status == Status::infeasible) result.direction = row.cwiseProduct(result.direction);
}

double objective_unit(const QuadraticProgram& p) {
  constexpr double kLikeOne = 1e6;
  const double size = std::max(peak(p.P), peak(p.q));
  return moderate(size, kLikeOne) ? 1 : std::max(size, 1e-300);  // of which there is an inverse
}

Scaled scale(const QuadraticProgram& p) {
  const int n = p.unknowns(), m = p.rows();
  Scaled s{p, Vector::Ones(n), Vector::Ones(m), 1 / objective_unit(p)};
  QuadraticProgram& t = s.program;
  const auto apply = [&] {
    t.P = p.P, t.A = p.A;
    visit_entries(t.P, [&](auto i, auto j, double& value) { value = value * s.cost * s.column[j] * s.column[i]; });
    visit_entries(t.A, [&](auto i, auto j, double& value) { value = value * s.row[i] * s.column[j]; });
  };
  const auto is_bound = [&](Eigen::Index row) { return p.A.outerIndexPtr()[row + 1] - p.A.outerIndexPtr()[row] == 1; };
  const auto raise = [](double& most, double value) { most = std::max(most, std::abs(value)); };
  apply();
  for (int round = 0; round < 10; ++round) {
    Vector columns = Vector::Zero(n), rows = Vector::Zero(m);
    visit_entries(t.P, [&](auto i, auto j, double value) { raise(columns[i], value), raise(columns[j], value); });
    visit_entries(t.A, [&](auto i, auto j, double value) {
      raise(rows[i], value);
      if (!is_bound(i)) raise(columns[j], value);
    });
    for (int j = 0; j < n; ++j)
      if (columns[j] == 0) columns[j] = std::abs(s.cost * p.q[j] * s.column[j]);
    divide(s.column, columns);
    divide(s.row, rows);
    if (peak(t.P) > 0) s.cost /= std::sqrt(peak(t.P));
    apply();
  }
  t.q = s.cost * p.q.cwiseProduct(s.column);
  const Vector curvature = t.P.diagonal();
  const double rounding = std::numeric_limits<double>::epsilon() * peak(t.P);
  double unit = 0;
  for (int j = 0; j < n; ++j)
    if (curvature[j] > rounding) unit = std::max(unit, std::abs(t.q[j]) / std::sqrt(curvature[j]));
  for (int i = 0; i < m; ++i) unit = std::max({unit, s.row[i] * p.low[i], -s.row[i] * p.high[i]});
  if (!(unit > 0) || !std::isfinite(unit)) unit = 1;
  s.column *= unit, s.row /= unit, s.cost /= unit * unit, t.q /= unit;
  for (int i = 0; i < m; ++i) t.low[i] *= s.row[i], t.high[i] *= s.row[i];
  const double size = std::max(peak(t.q), peak(t.P)), rest = size > 0 ? 1 / size : 1;
  t.P *= rest;
  t.q *= rest;
  s.cost *= rest;
  t.r *= s.cost;
  return s;
}

std::optional<Scaled> scale_by_curvature(const QuadraticProgram& p) {
  const Vector curvature = p.P.diagonal();
  if (p.unknowns() == 0 || !(curvature.minCoeff() > 0)) return std::nullopt;
  Scaled s{p, curvature.cwiseSqrt().cwiseInverse(), Vector::Ones(p.rows())};
  const double size = peak(p.q.cwiseProduct(s.column));
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  s.column *= size;
  s.cost = 1 / size / size;
  if (!s.column.allFinite() || !(s.cost > 0) || !std::isfinite(s.cost)) return std::nullopt;
  QuadraticProgram& t = s.program;
  t.P = SparseMatrix(s.column.asDiagonal() * p.P * s.column.asDiagonal()) * s.cost;
  t.q = s.cost * p.q.cwiseProduct(s.column);
  t.r *= s.cost;
  t.A = p.A * s.column.asDiagonal();
  for (int i = 0; i < p.rows(); ++i) {
    const double largest = peak(Vector(t.A.row(i).transpose()));
    if (largest > 0) s.row[i] = 1 / largest;
    t.low[i] *= s.row[i], t.high[i] *= s.row[i];
  }
  t.A = SparseRows(s.row.asDiagonal() * t.A);
  return s;
}

double imbalance(const QuadraticProgram& program, const Vector& x, const Vector& y, Rounding nothing) {
  constexpr double kRounding = 1e-15, kUndriven = 1e-9, kDriven = 1e-3;
  const auto scaled = scale_by_curvature(program);
  if (!scaled) return 0;
  const QuadraticProgram& p = scaled->program;
  const Vector u = x.cwiseQuotient(scaled->column), v = scaled->cost * y.cwiseQuotient(scaled->row), Au = p.A * u;
  const SparseRows sizes = p.A.cwiseAbs();
  // What drives the unknowns, and with the multipliers of rows. Those of rows that are far from their limits are no scale of anything.
  const Vector own = times(p.P.cwiseAbs(), u.cwiseAbs()) + p.q.cwiseAbs(), terms = own + sizes.transpose() * v.cwiseAbs();
  const Vector moved = sizes * terms, moved_by_own = sizes * own;
  const double greatest = peak(terms);
  const auto share = [&](double left, double of, bool driven = false) {
    return left > (driven || nothing == Rounding::own ? kRounding * of : kUndriven * greatest) ? left / of : 0;
  };
  double worst = 0;
  Vector apart = v.cwiseAbs();
  for (int r = 0; r < p.rows(); ++r) {
    worst = std::max(worst, share(std::max(p.low[r] - Au[r], Au[r] - p.high[r]), moved[r]));
    apart[r] *= std::min(1.0, share(std::abs(Au[r] - (v[r] > 0 ? p.high[r] : p.low[r])), moved_by_own[r]));
  }
  const Vector left = (times(p.P, u) + p.q + p.A.transpose() * v).cwiseAbs() + sizes.transpose() * apart;
  for (int j = 0; j < p.unknowns(); ++j) worst = std::max(worst, share(left[j], terms[j], std::abs(p.q[j]) > kDriven * terms[j]));
  return worst;
}

}  // namespace dotyk::program
