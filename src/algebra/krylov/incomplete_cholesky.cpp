#include <cmath>

#include "algebra/krylov/preconditioner.hpp"
#include "algebra/direct/sparse_sweeps.hpp"
#include "base/error.hpp"

namespace dotyk::algebra {
namespace {

constexpr double kLeastPivot = 1e-8;  ///< of K's diagonal entry
constexpr double kFirstShift = 1e-3;
constexpr double kGreatestShift = 1e3;  ///< long before it K + σ diag(K) is diagonally dominant for a bounded row length

/// Subtracts l_j l_jᵀ, as far as the pattern goes, from the columns after j.
void update_from(SparseMatrix& l, int j) {
  const int *start = l.outerIndexPtr(), *row = l.innerIndexPtr();
  double* value = l.valuePtr();
  for (int a = start[j] + 1; a < start[j + 1]; ++a) {
    const int column = row[a];
    int place = start[column];
    for (int b = a; b < start[j + 1]; ++b) {
      while (place < start[column + 1] && row[place] < row[b]) ++place;
      if (place == start[column + 1]) break;
      if (row[place] == row[b]) value[place] -= value[a] * value[b];
    }
  }
}

/// l: K on entry, its incomplete factor on return. False where a pivot is too small.
bool factor_on_pattern(SparseMatrix& l, double shift) {
  const int* start = l.outerIndexPtr();
  double* value = l.valuePtr();
  const Vector diagonal = l.diagonal();
  for (int j = 0; j < l.cols(); ++j) value[start[j]] *= 1 + shift;
  for (int j = 0; j < l.cols(); ++j) {
    if (!(value[start[j]] > kLeastPivot * diagonal[j])) return false;
    const double pivot = value[start[j]] = std::sqrt(value[start[j]]);
    for (int k = start[j] + 1; k < start[j + 1]; ++k) value[k] /= pivot;
    update_from(l, j);
  }
  return true;
}

}  // namespace

IncompleteCholesky::IncompleteCholesky(const SparseMatrix& lower) : Preconditioner(lower), l_(lower) {
  while (!factor_on_pattern(l_, shift_)) {
    shift_ = shift_ == 0 ? kFirstShift : 2 * shift_;
    if (!(shift_ < kGreatestShift)) throw InputError("incomplete Cholesky factorisation: the matrix is not positive definite");
    l_ = lower;
  }
  d_ = l_.diagonal();
}

DenseMatrix IncompleteCholesky::forward(const Eigen::Ref<const DenseMatrix>& b) const {
  DenseMatrix x = b;
  sweep_forward(l_, d_, x);
  return x;
}

DenseMatrix IncompleteCholesky::backward(const Eigen::Ref<const DenseMatrix>& x) const {
  DenseMatrix y = x;
  sweep_backward(l_, d_, y);
  return y;
}

DenseMatrix IncompleteCholesky::lift(const Eigen::Ref<const DenseMatrix>& r) const {
  DenseMatrix y = r;
  multiply_lower(l_, d_, y);
  return y;
}

double IncompleteCholesky::bytes() const {
  return 12.0 * static_cast<double>(l_.nonZeros()) + 8.0 * static_cast<double>(size());
}

}  // namespace dotyk::algebra
