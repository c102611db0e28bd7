#include "program/kkt.hpp"

#include <algorithm>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::program {
namespace {

using algebra::DenseMatrix;

/// The lower triangle; its pattern does not depend on δ, D and which rows are taken.
SparseMatrix regularised_matrix(const QuadraticProgram& p, double delta, const Vector& D, const std::vector<char>& taken) {
  const int n = p.unknowns(), m = p.rows();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(p.P.nonZeros() + p.A.nonZeros() + n + m);
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, delta);
  for (int i = 0; i < m; ++i) entries.emplace_back(n + i, n + i, taken[i] ? -D[i] : -1);
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(p.P, j); it; ++it) entries.emplace_back(static_cast<int>(it.row()), j, it.value());
  for (int i = 0; i < m; ++i)
    for (SparseRows::InnerIterator it(p.A, i); it; ++it)
      entries.emplace_back(n + i, static_cast<int>(it.col()), taken[i] ? it.value() : 0);
  SparseMatrix lower(n + m, n + m);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

/// One cycle of GMRES with right preconditioning from z = 0: the correction to z.
Vector cycle(const Apply& K, const Apply& regularised, const Vector& residual, double target, int most, int& steps) {
  std::vector<Vector> v{residual.normalized()}, corrections;
  DenseMatrix h = DenseMatrix::Zero(most + 1, most);
  Vector best;
  const double size = residual.norm();
  for (int k = 0; k < most; ++k) {
    corrections.push_back(regularised(v[k]));
    ++steps;
    Vector w = K(corrections[k]);
    for (int round = 0; round < 2; ++round)
      for (int i = 0; i <= k; ++i) {
        const double c = v[i].dot(w);
        h(i, k) += c;
        w -= c * v[i];
      }
    h(k + 1, k) = w.norm();
    const Vector b = size * Vector::Unit(k + 2, 0);
    const DenseMatrix H = h.topLeftCorner(k + 2, k + 1);
    best = algebra::least_squares(H, b);
    if ((H * best - b).norm() <= target || h(k + 1, k) <= 1e-14 * size) break;
    v.push_back(w / h(k + 1, k));
  }
  Vector z = Vector::Zero(residual.size());
  for (Eigen::Index i = 0; i < best.size(); ++i) z += best[i] * corrections[i];
  return z;
}

}  // namespace

Kkt::Kkt(const QuadraticProgram& program)
    : program_(program),
      factor_(regularised_matrix(program, 1, Vector::Ones(program.rows()), std::vector<char>(program.rows(), 1))) {}

bool Kkt::factor(double delta, const Vector& D, const std::vector<char>& taken) {
  return factor_.factor(regularised_matrix(program_, delta, D, taken)) && factor_.negative_pivots() == program_.rows();
}

Vector kkt_times(const QuadraticProgram& p, const std::vector<char>& taken, const Vector& z) {
  const int n = p.unknowns(), m = p.rows();
  Vector out(n + m), y = z.tail(m);
  out.tail(m) = p.A * z.head(n);
  for (int r = 0; r < m; ++r)
    if (!taken[r]) y[r] = out[n + r] = 0;
  out.head(n) = times(p.P, z.head(n)) + p.A.transpose() * y;
  return out;
}

Refined refine(const Apply& K, const Apply& regularised, const Vector& b, double target, int most_steps) {
  Refined out{regularised(b), {}};
  out.residual = b - K(out.z);
  for (int steps = 1; peak(out.residual) > target && steps < most_steps;) {
    const Vector z = out.z + cycle(K, regularised, out.residual, 0.1 * target, std::min(8, most_steps - steps), steps);
    const Vector residual = b - K(z);
    const bool enough = !(residual.norm() < 0.9 * out.residual.norm());
    if (residual.norm() < out.residual.norm()) out.z = z, out.residual = residual;
    if (enough) break;
  }
  return out;
}

}  // namespace dotyk::program
