#include "program/scaling.hpp"

#include <algorithm>
#include <cmath>

#include "base/moderate.hpp"

namespace dotyk::program {
namespace {

/// Divides by the root of what is not zero.
void divide(Vector& factor, const Vector& largest) {
  for (int i = 0; i < factor.size(); ++i)
    if (largest[i] > 0) factor[i] /= std::sqrt(largest[i]);
}

}  // namespace

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
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(p.P, j); it; ++it)
        t.P.valuePtr()[&it.value() - p.P.valuePtr()] = it.value() * s.cost * s.column[j] * s.column[it.row()];
    for (int i = 0; i < m; ++i)
      for (SparseRows::InnerIterator it(p.A, i); it; ++it)
        t.A.valuePtr()[&it.value() - p.A.valuePtr()] = it.value() * s.row[i] * s.column[it.col()];
  };
  apply();
  for (int round = 0; round < 10; ++round) {
    Vector columns = Vector::Zero(n), rows = Vector::Zero(m);
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(t.P, j); it; ++it) {
        columns[j] = std::max(columns[j], std::abs(it.value()));
        columns[it.row()] = std::max(columns[it.row()], std::abs(it.value()));
      }
    for (int i = 0; i < m; ++i)
      for (SparseRows::InnerIterator it(t.A, i); it; ++it) {
        columns[it.col()] = std::max(columns[it.col()], std::abs(it.value()));
        rows[i] = std::max(rows[i], std::abs(it.value()));
      }
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

}  // namespace dotyk::program
