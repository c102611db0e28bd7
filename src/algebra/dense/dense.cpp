#include "algebra/dense/dense.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
            const int* n, const double* alpha, const double* a, const int* lda, double* b,
            const int* ldb);
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* beta, double* c, const int* ldc);
void dgeqrf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work, const int* lwork, int* info);
void dormqr_(const char* side, const char* trans, const int* m, const int* n, const int* k, const double* a, const int* lda, const double* tau,
             double* c, const int* ldc, double* work, const int* lwork, int* info);
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda, double* s, double* u,
             const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork, int* iwork, int* info);
}

namespace dotyk::algebra {
namespace {

void triangular_solve(const Eigen::Ref<const DenseMatrix>& l, Eigen::Ref<DenseMatrix> x, const char* transposed) {
  const int m = static_cast<int>(x.rows()), n = static_cast<int>(x.cols()),
            lda = static_cast<int>(l.outerStride()), ldb = static_cast<int>(x.outerStride());
  if (l.rows() != x.rows()) throw std::logic_error("triangular solve: sizes differ");
  if (m == 0 || n == 0) return;
  const BlasThreads threads(1.0 * m * m * n);
  const double one = 1;
  stoppable([&] { dtrsm_("L", "L", transposed, "N", &m, &n, &one, l.data(), &lda, x.data(), &ldb); });
}

/// alpha: X Xᵀ ("N") or XᵀX ("T").
DenseMatrix rank_update(const DenseMatrix& x, const char* transposed) {
  const int n = static_cast<int>(*transposed == 'N' ? x.rows() : x.cols()),
            k = static_cast<int>(*transposed == 'N' ? x.cols() : x.rows()),
            lda = static_cast<int>(x.rows());
  DenseMatrix c = DenseMatrix::Zero(n, n);
  if (n == 0 || k == 0) return c;
  const BlasThreads threads(1.0 * n * n * k);
  const double one = 1, zero = 0;
  stoppable([&] { dsyrk_("L", transposed, &n, &k, &one, x.data(), &lda, &zero, c.data(), &n); });
  c.triangularView<Eigen::StrictlyUpper>() = c.transpose();
  return c;
}

}  // namespace

bool cholesky(DenseMatrix& a) {
  const int n = static_cast<int>(a.rows());
  if (n == 0) return true;
  const BlasThreads threads(1.0 / 3 * n * n * n);
  int info = 0;
  stoppable([&] { dpotrf_("L", &n, a.data(), &n, &info); });
  if (info != 0) return false;
  a.triangularView<Eigen::StrictlyUpper>().setZero();
  return true;
}

void solve_lower(const Eigen::Ref<const DenseMatrix>& l, Eigen::Ref<DenseMatrix> x) { triangular_solve(l, x, "N"); }
void solve_lower_transposed(const Eigen::Ref<const DenseMatrix>& l, Eigen::Ref<DenseMatrix> x) { triangular_solve(l, x, "T"); }

DenseMatrix product(const Eigen::Ref<const DenseMatrix>& a, const Eigen::Ref<const DenseMatrix>& b) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(b.cols()), k = static_cast<int>(a.cols()),
            lda = static_cast<int>(a.outerStride()), ldb = static_cast<int>(b.outerStride());
  if (a.cols() != b.rows()) throw std::logic_error("product: sizes differ");
  if (m == 0 || n == 0 || k == 0) return DenseMatrix::Zero(m, n);
  DenseMatrix c(m, n);
  const BlasThreads threads(2.0 * m * n * k);
  const double one = 1, zero = 0;
  stoppable([&] { dgemm_("N", "N", &m, &n, &k, &one, a.data(), &lda, b.data(), &ldb, &zero, c.data(), &m); });
  return c;
}

DenseMatrix gram(const DenseMatrix& x) { return rank_update(x, "T"); }
DenseMatrix square(const DenseMatrix& l) { return rank_update(l, "N"); }

OrthogonalFactors orthogonal_factors(DenseMatrix x) {
  constexpr int kPanel = 64;  // columns whose reflections are made between two questions whether to stop
  const int m = static_cast<int>(x.rows()), n = static_cast<int>(x.cols()), length = 64 * std::max(n, 1);
  if (m < n) throw std::logic_error("orthogonal factors: fewer rows than columns");
  if (n == 0) return {x, DenseMatrix(0, 0)};
  const BlasThreads threads(2.0 * m * n * n);
  Vector tau(n), work(length);
  const auto reflect = [&](const char* transposed, int j, DenseMatrix& columns, int first) {
    ask_to_stop();
    const int below = m - j, width = std::min(kPanel, n - j), count = n - first;
    int info = 0;
    stoppable([&] { dormqr_("L", transposed, &below, &count, &width, &x(j, j), &m, tau.data() + j, &columns(j, first), &m, work.data(), &length, &info); });
  };
  for (int j = 0; j < n; j += kPanel) {
    const int below = m - j, width = std::min(kPanel, n - j);
    int info = 0;
    dgeqrf_(&below, &width, &x(j, j), &m, tau.data() + j, work.data(), &length, &info);
    if (j + width < n) reflect("T", j, x, j + width);
  }
  DenseMatrix Q = DenseMatrix::Identity(m, n);
  for (int j = (n - 1) / kPanel * kPanel; j >= 0; j -= kPanel) reflect("N", j, Q, j);
  return {std::move(Q), x.topRows(n).triangularView<Eigen::Upper>()};
}

DenseMatrix orthonormal(const DenseMatrix& x) {
  if (x.size() == 0) return x;
  return Eigen::HouseholderQR<DenseMatrix>(x).householderQ() * DenseMatrix::Identity(x.rows(), x.cols());
}

Vector singular_values(DenseMatrix a) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols()), count = std::min(m, n), one = 1;
  if (count == 0) return Vector();
  if (!a.allFinite()) return Vector::Constant(count, std::numeric_limits<double>::quiet_NaN());
  const BlasThreads threads(8.0 / 3 * count * count * std::max(m, n));
  Vector s(count);
  std::vector<int> integers(8 * static_cast<std::size_t>(count));
  double unused = 0, best_length = 0;
  int info = 0, length = -1;
  const auto factor = [&](double* work) {
    dgesdd_("N", &m, &n, a.data(), &m, s.data(), &unused, &one, &unused, &one, work, &length, integers.data(), &info);
  };
  factor(&best_length);  // asks for the length of the work space
  length = static_cast<int>(best_length);
  Vector work(length);
  factor(work.data());
  if (info != 0) throw std::runtime_error("the singular values did not converge");
  return s;
}

double smallest_singular_value(DenseMatrix a) {
  if (a.rows() != a.cols()) throw std::logic_error("smallest singular value: the matrix is not square");
  if (a.size() == 0) return std::numeric_limits<double>::infinity();
  return singular_values(std::move(a)).tail(1)[0];
}

DenseMatrix pure(DenseMatrix V) {
  int done = 0;
  for (int i = 0; i < V.rows() && done < V.cols(); ++i) {
    Eigen::Index pivot;
    const double largest = V.row(i).tail(V.cols() - done).cwiseAbs().maxCoeff(&pivot);
    if (largest < 1e-7) continue;
    V.col(done).swap(V.col(done + pivot));
    V.col(done) /= V(i, done);
    for (int k = 0; k < V.cols(); ++k)
      if (k != done) V.col(k) -= V(i, k) * V.col(done);
    ++done;
  }
  return V.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; });
}

}  // namespace dotyk::algebra
