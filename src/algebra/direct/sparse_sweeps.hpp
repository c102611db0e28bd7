#pragma once

#include "algebra/types.hpp"

// Sweeps with a sparse lower triangle by columns, each of which begins with its diagonal entry. The diagonal that
// counts is given apart from it: SSOR's differs from the matrix's.

namespace dotyk::algebra {

/// x := (diag(d) + L)⁻¹ x, L the part of `lower` below its diagonal; every column of x.
inline void sweep_forward(const SparseMatrix& lower, const Vector& d, Eigen::Ref<DenseMatrix> x) {
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
inline void sweep_backward(const SparseMatrix& lower, const Vector& d, Eigen::Ref<DenseMatrix> x) {
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
inline void multiply_lower(const SparseMatrix& lower, const Vector& d, Eigen::Ref<DenseMatrix> x) {
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

}  // namespace dotyk::algebra
