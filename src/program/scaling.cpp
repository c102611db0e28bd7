#include "program/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "algebra/direct/quasi_definite.hpp"
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

/// Is P positive definite by more than rounding, whatever the units of its unknowns?
bool strictly_convex(const SparseMatrix& lower) {
  constexpr double kRounding = 1e-9;
  SparseMatrix less = lower;
  if (less.rows() > 0 && !(Vector(less.diagonal()).minCoeff() > 0)) return false;
  for (Eigen::Index j = 0; j < less.rows(); ++j) less.coeffRef(j, j) *= 1 - kRounding;
  algebra::QuasiDefinite factor(less);
  return factor.factor(less) && factor.negative_pivots() == 0;
}

/// exp(s_i) of least Σ (log|k_ij| + s_i + s_j)² over the entries of the symmetric K = [P Aᵀ q; A 0 b; qᵀ bᵀ 0], b all finite
/// limits (Curtis and Reid 1972): scaled by them the entries are as near to 1 as they can be. Units of unknowns, rows and
/// the objective make no difference to what results. By conjugate gradients; the matrix of the normal equations has the
/// pattern of K, and on the diagonal the number of entries in the row besides.
Vector curtis_reid(const QuadraticProgram& p) {
  constexpr double kEnough = 1e-3;
  constexpr int kMost = 50;
  const int n = p.unknowns(), m = p.rows();
  std::vector<Eigen::Triplet<double>> entries;  // of the lower triangle, their logarithms
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {
    if (value != 0 && std::isfinite(value)) entries.emplace_back(static_cast<int>(i), static_cast<int>(j), std::log(std::abs(value)));
  };
  visit_entries(p.P, add);
  visit_entries(p.A, [&](auto i, auto j, double value) { add(n + i, j, value); });
  for (int j = 0; j < n; ++j) add(n + m, j, p.q[j]);
  for (int i = 0; i < m; ++i) add(n + m, n + i, p.low[i]), add(n + m, n + i, p.high[i]);
  Vector count = Vector::Zero(n + m + 1), s = count, r = count;
  for (const auto& e : entries)
    for (const int i : {e.row(), e.col()}) {
      r[i] -= e.value(), count[i] += 1;
      if (e.row() == e.col()) break;
    }
  const auto times = [&](const Vector& v) {
    Vector out = count.cwiseProduct(v);
    for (const auto& e : entries) {
      out[e.row()] += v[e.col()];
      if (e.row() != e.col()) out[e.col()] += v[e.row()];
    }
    return out;
  };
  count = count.cwiseMax(1);
  Vector d = r.cwiseQuotient(count);
  double rho = r.dot(d);
  for (int k = 0; k < kMost && peak(Vector(r.cwiseQuotient(count))) > kEnough; ++k) {
    const Vector Kd = times(d);
    const double alpha = rho / d.dot(Kd);
    s += alpha * d, r -= alpha * Kd;
    const Vector z = r.cwiseQuotient(count);
    const double before = std::exchange(rho, r.dot(z));
    d = z + rho / before * d;
  }
  return s.array().exp();
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
  if (!strictly_convex(p.P)) {
    const Vector unit = curtis_reid(p);
    const double all = unit[n + m];
    s.column = unit.head(n) / all, s.row = unit.segment(n, m) * all, s.cost = all * all;
  }
  QuadraticProgram& t = s.program;
  const auto apply = [&] {
    t.P = p.P, t.A = p.A;
    visit_entries(t.P, [&](auto i, auto j, double& value) { value = value * s.cost * s.column[j] * s.column[i]; });
    visit_entries(t.A, [&](auto i, auto j, double& value) { value = value * s.row[i] * s.column[j]; });
  };
  const auto raise = [](double& most, double value) { most = std::max(most, std::abs(value)); };
  apply();
  for (int round = 0; round < 10; ++round) {
    Vector columns = Vector::Zero(n), rows = Vector::Zero(m);
    visit_entries(t.P, [&](auto i, auto j, double value) { raise(columns[i], value), raise(columns[j], value); });
    visit_entries(t.A, [&](auto i, auto j, double value) { raise(rows[i], value), raise(columns[j], value); });
    divide(s.column, columns);
    divide(s.row, rows);
    apply();
  }
  t.q = s.cost * p.q.cwiseProduct(s.column);
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
  constexpr double kRounding = 1e-15, kDriven = 1e-3;
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
    return left > kRounding * (driven || nothing == Rounding::own ? of : greatest) ? left / of : 0;
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
