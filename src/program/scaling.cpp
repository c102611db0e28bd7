#include "program/scaling.hpp"

#include <cmath>

namespace dotyk::program {
namespace {

/// Divides by the root of what is not zero.
void divide(Vector& factor, const Vector& largest) {
  for (int i = 0; i < factor.size(); ++i)
    if (largest[i] > 0) factor[i] /= std::sqrt(largest[i]);
}

}  // namespace

Scaled scale(const QuadraticProgram& p) {
  const int n = p.unknowns(), m = p.rows();
  Scaled s{p, Vector::Ones(n), Vector::Ones(m)};
  QuadraticProgram& t = s.program;
  const auto apply = [&] {
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(p.P, j); it; ++it)
        t.P.valuePtr()[&it.value() - p.P.valuePtr()] = it.value() * s.column[j] * s.column[it.row()];
    for (int i = 0; i < m; ++i)
      for (SparseRows::InnerIterator it(p.A, i); it; ++it)
        t.A.valuePtr()[&it.value() - p.A.valuePtr()] = it.value() * s.row[i] * s.column[it.col()];
  };
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
  t.q = p.q.cwiseProduct(s.column);
  for (int i = 0; i < m; ++i) t.low[i] *= s.row[i], t.high[i] *= s.row[i];
  double size = t.q.lpNorm<Eigen::Infinity>(), P = 0;
  for (int k = 0; k < t.P.nonZeros(); ++k) P = std::max(P, std::abs(t.P.valuePtr()[k]));
  size = std::max(size, P);
  if (size > 0) s.cost = 1 / size;
  t.P *= s.cost;
  t.q *= s.cost;
  t.r *= s.cost;
  return s;
}

}  // namespace dotyk::program
