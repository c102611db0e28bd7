#include "algebra/krylov/lanczos.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

namespace dotyk::algebra {
namespace {

constexpr double kSettled = 1e-3;
/// Of the greatest Ritz value: a next direction so small is rounding.
constexpr double kExhausted = 1e-14;

SpectrumEnds ends_of(const Vector& diagonal, const Vector& below, Eigen::Index steps) {
  const Eigenpairs ritz = tridiagonal_eigenpairs(diagonal.head(steps), below.head(steps - 1));
  const auto last = ritz.vectors.row(steps - 1);
  return {ritz.values[0], ritz.values[steps - 1], below[steps - 1] * std::abs(last[0]),
          below[steps - 1] * std::abs(last[steps - 1]), static_cast<int>(steps)};
}

}  // namespace

SpectrumEnds lanczos(const LinearMap& A, Vector v, int most, Ends ends) {
  SpectrumEnds result;
  const Eigen::Index steps = std::min<Eigen::Index>(v.size(), most);
  if (v.size() == 0 || !(v.norm() > 0)) return result;
  v.normalize();
  DenseMatrix basis(v.size(), steps);
  Vector diagonal(steps), below(steps);
  for (Eigen::Index k = 0; k < steps; ++k) {
    basis.col(k) = v;
    Vector w = A(v);
    diagonal[k] = v.dot(w);
    for (int twice = 0; twice < 2; ++twice)
      w -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * w);
    below[k] = w.norm();
    result = ends_of(diagonal, below, k + 1);
    const bool settled = result.greatest_residual <= kSettled * result.greatest &&
                         (ends == Ends::greatest || result.least_residual <= kSettled * result.least);
    if (settled || below[k] <= kExhausted * std::abs(result.greatest)) break;
    v = w / below[k];
  }
  return result;
}

Vector lanczos_start(Eigen::Index n) {
  Vector v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = 1.5 + std::sin(1.0 + 1.7 * static_cast<double>(i * i % 1009));
  return v.normalized();
}

double largest_eigenvalue(const DenseMatrix& A, const Vector& scale) {
  constexpr int kSteps = 60;
  if (A.size() == 0) return 0;
  const Vector s = scale.size() ? scale : Vector::Ones(A.rows());
  const double always = s.cwiseProduct(A.cwiseAbs() * s).maxCoeff();  // the greatest row sum
  if (!(always > 0)) return 0;
  // Rounding of the Ritz value itself is allowed for.
  const auto scaled = [&](const Vector& v) -> Vector { return s.cwiseProduct(A * s.cwiseProduct(v)); };
  return std::min(always, (1 + 1e-12) * lanczos(scaled, lanczos_start(s.size()), kSteps, Ends::greatest).bound());
}

double proved_largest_eigenvalue(const DenseMatrix& A) {
  double bound = largest_eigenvalue(A);
  for (; bound > 0; bound *= 1.01) {
    DenseMatrix above = -A;
    above.diagonal().array() += bound;
    if (cholesky(above)) break;
  }
  return bound;
}

}  // namespace dotyk::algebra
