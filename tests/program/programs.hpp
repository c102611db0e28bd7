#pragma once

#include <cmath>
#include <optional>

#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"
#include "program/active_set.hpp"
#include "program/augmented_lagrangian.hpp"
#include "program/interior_point.hpp"

namespace dotyk::test {

using algebra::DenseMatrix;
using algebra::Vector;
using program::QuadraticProgram;

inline QuadraticProgram quadratic(const DenseMatrix& P, const Vector& q, const DenseMatrix& A, const Vector& low,
                                  const Vector& high) {
  QuadraticProgram p;
  p.P = lower(P);
  p.q = q;
  p.A = A.sparseView(0, 0);
  p.low = low, p.high = high;
  return p;
}

/// FFᵀ of a rank.
inline DenseMatrix semidefinite(Random& random, int n, int rank) {
  const DenseMatrix F = random.matrix(n, rank);
  return F * F.transpose();
}

/// A feasible program: general rows, some of them equalities or one-sided, and a box that keeps it bounded.
inline QuadraticProgram boxed(Random& random, int n, int rows, int rank) {
  DenseMatrix A(rows + n, n);
  A << random.matrix(rows, n), DenseMatrix::Identity(n, n);
  Vector inside = random.vector(n), low(rows + n), high(rows + n);
  const Vector a = A * inside;
  int equalities = 0;
  for (int r = 0; r < rows; ++r) {
    const int kind = equalities + 1 < n ? random.below(4) : 1 + random.below(3);
    equalities += kind == 0;
    low[r] = kind == 0 ? a[r] : kind == 1 ? -INFINITY : a[r] - random.between(0, 1);
    high[r] = kind == 0 ? a[r] : kind == 2 ? INFINITY : a[r] + random.between(0, 1);
  }
  for (int j = 0; j < n; ++j) low[rows + j] = -2, high[rows + j] = 2;
  return quadratic(semidefinite(random, n, rank), 3 * random.vector(n), A, low, high);
}

/// The least objective over all working sets whose KKT point is feasible: the optimum of a convex program
/// that has one at which the KKT matrix is regular; empty where there is none.
inline std::optional<double> by_enumeration(const QuadraticProgram& p) {
  const int n = p.unknowns(), m = p.rows();
  const DenseMatrix P = full(p.P), A = p.A;
  std::optional<double> best;
  std::vector<int> place(m, 0);  // 0 free, 1 low, 2 high
  for (;;) {
    std::vector<int> rows;
    bool possible = true;
    for (int r = 0; r < m; ++r) {
      if (p.equality(r)) possible = possible && place[r] == 1;
      if (place[r]) rows.push_back(r), possible = possible && std::isfinite(place[r] == 1 ? p.low[r] : p.high[r]);
    }
    const int k = static_cast<int>(rows.size());
    if (possible && k <= n) {
      DenseMatrix K = DenseMatrix::Zero(n + k, n + k);
      Vector b = Vector::Zero(n + k);
      K.topLeftCorner(n, n) = P;
      b.head(n) = -p.q;
      for (int i = 0; i < k; ++i) {
        K.block(n + i, 0, 1, n) = A.row(rows[i]), K.block(0, n + i, n, 1) = A.row(rows[i]).transpose();
        b[n + i] = place[rows[i]] == 1 ? p.low[rows[i]] : p.high[rows[i]];
      }
      const algebra::PivotedLu lu(K);
      if (lu.regular()) {
        const Vector x = lu.solve(b).head(n), a = A * x;
        if (((a - p.high).array() <= 1e-9).all() && ((p.low - a).array() <= 1e-9).all()) {
          const double value = program::objective(p, x);
          if (!best || value < *best) best = value;
        }
      }
    }
    int r = 0;
    while (r < m && ++place[r] == 3) place[r++] = 0;
    if (r == m) return best;
  }
}

inline program::ActiveSet one() { return {}; }
inline program::ActiveSet many() {
  program::ActiveSet s;
  s.change = program::ActiveSet::Change::many;
  return s;
}

inline double worst(const program::Residuals& r) { return std::max({r.stationarity, r.feasibility, r.complementarity}); }

}  // namespace dotyk::test
