#include "algebra/largest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace dotyk::algebra {
namespace {

constexpr int kSteps = 60;
constexpr double kSettled = 1e-3;

double greatest_row_sum(const DenseMatrix& A, const Vector& s) {
  return s.cwiseProduct(A.cwiseAbs() * s).maxCoeff();
}

/// No symmetry of a mesh leaves it in an invariant subspace.
Vector start(Eigen::Index n) {
  Vector v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = 1.5 + std::sin(1.0 + 1.7 * static_cast<double>(i * i % 1009));
  return v.normalized();
}

/// θ + r of the greatest Ritz value in span{v, Av, …}, every direction orthogonalised against all before.
double by_lanczos(const DenseMatrix& A, const Vector& s, double enough) {
  const Eigen::Index n = s.size(), most = std::min<Eigen::Index>(n, kSteps);
  DenseMatrix basis(n, most);
  Vector diagonal(most), below(most);
  Vector v = start(n);
  double bound = enough;
  for (Eigen::Index k = 0; k < most; ++k) {
    basis.col(k) = v;
    Vector w = s.cwiseProduct(A * s.cwiseProduct(v));
    diagonal[k] = v.dot(w);
    for (int twice = 0; twice < 2; ++twice)
      w -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * w);
    below[k] = w.norm();
    Eigen::SelfAdjointEigenSolver<DenseMatrix> ritz;
    ritz.computeFromTridiagonal(diagonal.head(k + 1), below.head(k));
    const double theta = ritz.eigenvalues()[k], residual = below[k] * std::abs(ritz.eigenvectors()(k, k));
    bound = theta + residual;
    if (residual <= kSettled * theta || below[k] <= 1e-14 * enough) break;
    v = w / below[k];
  }
  return bound;
}

}  // namespace

double largest_eigenvalue(const DenseMatrix& A, const Vector& scale) {
  if (A.size() == 0) return 0;
  const Vector s = scale.size() ? scale : Vector::Ones(A.rows());
  const double always = greatest_row_sum(A, s);
  if (!(always > 0)) return 0;
  // Rounding of the Ritz value itself is allowed for.
  return std::min(always, (1 + 1e-12) * by_lanczos(A, s, always));
}

}  // namespace dotyk::algebra
