#include "algebra/krylov/largest_eigenvalue.hpp"

#include <algorithm>

#include "algebra/dense/dense.hpp"
#include "algebra/krylov/lanczos.hpp"

namespace dotyk::algebra {
namespace {

constexpr int kSteps = 60;

double greatest_row_sum(const DenseMatrix& A, const Vector& s) {
  return s.cwiseProduct(A.cwiseAbs() * s).maxCoeff();
}

}  // namespace

double largest_eigenvalue(const DenseMatrix& A, const Vector& scale) {
  if (A.size() == 0) return 0;
  const Vector s = scale.size() ? scale : Vector::Ones(A.rows());
  const double always = greatest_row_sum(A, s);
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
