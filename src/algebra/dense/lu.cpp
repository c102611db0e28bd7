#include "algebra/dense/lu.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* pivots, double* b, const int* ldb,
             int* info);
void dgecon_(const char* norm, const int* n, const double* a, const int* lda, const double* anorm, double* rcond, double* work, int* iwork,
             int* info);
void dlaswp_(const int* n, double* a, const int* lda, const int* first, const int* last, const int* pivots, const int* step);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n, const double* alpha,
            const double* a, const int* lda, double* b, const int* ldb);
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
}

namespace dotyk::algebra {

Lu::Lu(DenseMatrix a) : lu_(std::move(a)), exchanged_(static_cast<std::size_t>(lu_.rows())) {
  constexpr int kPanel = 512;  // columns: of 20 000 rows a tenth of a second
  const int n = static_cast<int>(lu_.rows());
  if (lu_.cols() != n) throw std::logic_error("LU: the matrix is not square");
  if (n == 0) return;
  norm_ = lu_.cwiseAbs().colwise().sum().maxCoeff();
  const BlasThreads threads(2.0 / 3 * n * n * n);
  const double one = 1, minus_one = -1;
  const int step = 1;
  for (int j = 0; j < n; j += kPanel) {
    ask_to_stop();
    const int columns = std::min(kPanel, n - j), rows = n - j, after = rows - columns, first = j + 1, last = j + columns;
    double *left = lu_.data(), *corner = &lu_(j, j), *right = corner + std::ptrdiff_t(columns) * n;
    int singular = 0;  // which regular() finds
    dgetrf_(&rows, &columns, corner, &n, &exchanged_[static_cast<std::size_t>(j)], &singular);
    for (int k = j; k < last; ++k) exchanged_[static_cast<std::size_t>(k)] += j;
    if (j > 0) dlaswp_(&j, left, &n, &first, &last, exchanged_.data(), &step);
    if (after == 0) break;
    stoppable([&] {
      dlaswp_(&after, left + std::ptrdiff_t(last) * n, &n, &first, &last, exchanged_.data(), &step);
      dtrsm_("L", "L", "N", "U", &columns, &after, &one, corner, &n, right, &n);
      dgemm_("N", "N", &after, &after, &columns, &minus_one, corner + columns, &n, right, &n, &one, right + columns, &n);
    });
  }
}

bool Lu::regular() const { return lu_.size() == 0 || lu_.diagonal().cwiseAbs().minCoeff<Eigen::PropagateNaN>() > 0; }

double Lu::rcond() const {
  const int n = static_cast<int>(lu_.rows());
  if (n == 0) return 1;
  if (!regular()) return 0;
  Vector work(4 * n);
  std::vector<int> integers(static_cast<std::size_t>(n));
  double rcond = 0;
  int info = 0;
  dgecon_("1", &n, lu_.data(), &n, &norm_, &rcond, work.data(), integers.data(), &info);
  return rcond;
}

void Lu::sweep(const char* transposed, Eigen::Ref<DenseMatrix> b) const {
  const int n = static_cast<int>(lu_.rows()), columns = static_cast<int>(b.cols()), ldb = columns == 1 ? n : static_cast<int>(b.outerStride());
  if (b.rows() != n) throw std::logic_error("LU: a right side of another size");
  if (n == 0 || columns == 0) return;
  int info = 0;
  dgetrs_(transposed, &n, &columns, lu_.data(), &n, exchanged_.data(), b.data(), &ldb, &info);
}

}  // namespace dotyk::algebra
