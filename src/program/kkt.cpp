#include "program/kkt.hpp"

#include <algorithm>

namespace dotyk::program {
namespace {

SparseMatrix pattern(const QuadraticProgram& p) {
  const int n = p.unknowns(), m = p.rows();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(p.P.nonZeros() + p.A.nonZeros() + n + m);
  for (int i = 0; i < n + m; ++i) entries.emplace_back(i, i, 1.0);
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(p.P, j); it; ++it)
      if (it.row() != j) entries.emplace_back(static_cast<int>(it.row()), j, 1.0);
  for (int i = 0; i < m; ++i)
    for (SparseRows::InnerIterator it(p.A, i); it; ++it) entries.emplace_back(n + i, static_cast<int>(it.col()), 1.0);
  SparseMatrix lower(n + m, n + m);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

Kkt::Kkt(const QuadraticProgram& program) : program_(&program), matrix_(pattern(program)), factor_(matrix_) {
  const int n = program.unknowns(), m = program.rows();
  const auto place = [&](int row, int column) {
    const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(first, last, row) - matrix_.innerIndexPtr());
  };
  for (int i = 0; i < n + m; ++i) diagonal_.push_back(place(i, i));
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(program.P, j); it; ++it) P_entry_.push_back(place(static_cast<int>(it.row()), j));
  for (int i = 0; i < m; ++i)
    for (SparseRows::InnerIterator it(program.A, i); it; ++it) {
      row_entry_.push_back(place(n + i, static_cast<int>(it.col())));
      row_of_.push_back(i);
    }
}

bool Kkt::factor(double delta, const Vector& D, const std::vector<char>& taken) {
  const QuadraticProgram& p = *program_;
  const int n = p.unknowns(), m = p.rows();
  double* value = matrix_.valuePtr();
  for (int i = 0; i < n; ++i) value[diagonal_[i]] = delta;
  for (int i = 0; i < m; ++i) value[diagonal_[n + i]] = taken[i] ? -D[i] : -1;
  for (int j = 0, k = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(p.P, j); it; ++it, ++k) {
      if (it.row() == j) value[P_entry_[k]] = it.value() + delta;
      else value[P_entry_[k]] = it.value();
    }
  for (std::size_t k = 0; k < row_entry_.size(); ++k)
    value[row_entry_[k]] = taken[row_of_[k]] ? p.A.valuePtr()[k] : 0;
  return factor_.factor(matrix_) && factor_.negative_pivots() == m;
}

Vector kkt_times(const QuadraticProgram& p, const std::vector<char>& taken, const Vector& z) {
  const int n = p.unknowns(), m = p.rows();
  Vector out(n + m);
  Vector y = z.tail(m);
  for (int r = 0; r < m; ++r)
    if (!taken[r]) y[r] = 0;
  out.head(n) = times(p.P, z.head(n)) + p.A.transpose() * y;
  out.tail(m) = p.A * z.head(n);
  for (int r = 0; r < m; ++r)
    if (!taken[r]) out[n + r] = 0;
  return out;
}

}  // namespace dotyk::program
