#include "algebra/krylov/preconditioner.hpp"

#include <Eigen/Sparse>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"

namespace dotyk::algebra {
namespace {

// Sweeps with a sparse lower triangle by columns, each of which begins with its diagonal entry. The diagonal that
// counts is given apart from it: SSOR's differs from the matrix's.

/// x := (diag(d) + L)⁻¹ x, L the part of `lower` below its diagonal; every column of x.
void sweep_forward(const SparseMatrix& lower, const Vector& d, DenseMatrix& x) {
  const int *start = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
  const double* value = lower.valuePtr();
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    double* v = x.col(c).data();
    for (int j = 0; j < lower.cols(); ++j) {
      const double vj = v[j] /= d[j];
      for (int k = start[j] + 1; k < start[j + 1]; ++k) v[row[k]] -= value[k] * vj;
    }
  }
}

/// x := (diag(d) + L)⁻ᵀ x.
void sweep_backward(const SparseMatrix& lower, const Vector& d, DenseMatrix& x) {
  const int *start = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
  const double* value = lower.valuePtr();
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    double* v = x.col(c).data();
    for (int j = static_cast<int>(lower.cols()) - 1; j >= 0; --j) {
      double sum = v[j];
      for (int k = start[j] + 1; k < start[j + 1]; ++k) sum -= value[k] * v[row[k]];
      v[j] = sum / d[j];
    }
  }
}

/// x := (diag(d) + L) x.
void multiply_lower(const SparseMatrix& lower, const Vector& d, DenseMatrix& x) {
  const int *start = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
  const double* value = lower.valuePtr();
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    double* v = x.col(c).data();
    for (int j = static_cast<int>(lower.cols()) - 1; j >= 0; --j) {  // v[j] is needed until its column is done
      for (int k = start[j] + 1; k < start[j + 1]; ++k) v[row[k]] += value[k] * v[j];
      v[j] *= d[j];
    }
  }
}

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

Preconditioner::Preconditioner(const SparseMatrix& lower) : K_(lower) {
  if (lower.rows() != lower.cols() || !lower.isCompressed())
    throw std::logic_error("preconditioner: the matrix is not square or not compressed");
  for (int j = 0; j < lower.cols(); ++j) {
    const int first = lower.outerIndexPtr()[j];
    if (first == lower.outerIndexPtr()[j + 1] || lower.innerIndexPtr()[first] != j || !(lower.valuePtr()[first] > 0))
      throw InputError(text("the matrix is not positive definite: the diagonal entry of unknown ", j + 1, " is not positive"));
  }
}

DenseMatrix Preconditioner::times(const Eigen::Ref<const DenseMatrix>& v) const {
  return K_.selfadjointView<Eigen::Lower>() * v;
}

DenseMatrix Triangular::forward(const Eigen::Ref<const DenseMatrix>& b) const {
  DenseMatrix x = b;
  sweep_forward(below(), d_, x);
  if (root_.size() > 0) x.array().colwise() *= root_.array();
  return x;
}

DenseMatrix Triangular::backward(const Eigen::Ref<const DenseMatrix>& x) const {
  DenseMatrix y = x;
  if (root_.size() > 0) y.array().colwise() *= root_.array();
  sweep_backward(below(), d_, y);
  return y;
}

DenseMatrix Triangular::lift(const Eigen::Ref<const DenseMatrix>& r) const {
  DenseMatrix y = r;
  if (root_.size() > 0) y.array().colwise() *= root_.array().inverse();
  multiply_lower(below(), d_, y);
  return y;
}

Ssor::Ssor(const SparseMatrix& lower, double omega) : Triangular(lower), omega_(omega) {
  if (!(omega > 0 && omega < 2)) throw InputError(text("SSOR's omega is ", omega, "; it must be between 0 and 2"));
  d_ = lower.diagonal() / omega;
  root_ = d_.cwiseSqrt();
}

DenseMatrix Ssor::apply(const Eigen::Ref<const DenseMatrix>& v) const {
  DenseMatrix w = root_.asDiagonal() * v, t = w;
  sweep_backward(K_, d_, t);
  w.noalias() -= ((2 - omega_) * d_).asDiagonal() * t;
  sweep_forward(K_, d_, w);
  return root_.asDiagonal() * (t + w);
}

IncompleteCholesky::IncompleteCholesky(const SparseMatrix& lower) : Triangular(lower), l_(lower) {
  while (!factor_on_pattern(l_, shift_)) {
    shift_ = shift_ == 0 ? kFirstShift : 2 * shift_;
    if (!(shift_ < kGreatestShift)) throw InputError("incomplete Cholesky factorisation: the matrix is not positive definite");
    l_ = lower;
  }
  d_ = l_.diagonal();
}

double IncompleteCholesky::bytes() const { return 12.0 * static_cast<double>(l_.nonZeros()) + 8.0 * static_cast<double>(size()); }

std::unique_ptr<Preconditioner> make_preconditioner(Preconditioning kind, const SparseMatrix& lower, double omega) {
  switch (kind) {
    case Preconditioning::none: return std::make_unique<NoPreconditioner>(lower);
    case Preconditioning::ssor: return std::make_unique<Ssor>(lower, omega);
    default: return std::make_unique<IncompleteCholesky>(lower);
  }
}

}  // namespace dotyk::algebra
