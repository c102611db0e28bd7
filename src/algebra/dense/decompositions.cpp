#include "algebra/dense/decompositions.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"

extern "C" void dstevr_(const char* jobz, const char* range, const int* n, double* d, double* e, const double* vl,
                        const double* vu, const int* il, const int* iu, const double* abstol, int* m, double* w,
                        double* z, const int* ldz, int* isuppz, double* work, const int* lwork, int* iwork,
                        const int* liwork, int* info);
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
namespace {

/// A decomposition of A that takes pivots below `threshold` of the greatest for zero.
template <class Decomposition>
std::shared_ptr<const Decomposition> pivoted(const DenseMatrix& A, std::optional<double> threshold) {
  const auto d = std::make_shared<Decomposition>();
  if (threshold) d->setThreshold(*threshold);
  d->compute(A);
  return d;
}

}  // namespace

Eigenpairs eigenpairs(const DenseMatrix& A) {
  const Eigen::SelfAdjointEigenSolver<DenseMatrix> e(A);
  return {e.eigenvalues(), e.eigenvectors()};
}

Vector eigenvalues(const DenseMatrix& A) { return Eigen::SelfAdjointEigenSolver<DenseMatrix>(A, Eigen::EigenvaluesOnly).eigenvalues(); }

Eigenpairs tridiagonal_eigenpairs(const Vector& diagonal, const Vector& off_diagonal) {
  Eigen::SelfAdjointEigenSolver<DenseMatrix> e;
  e.computeFromTridiagonal(diagonal, off_diagonal);
  return {e.eigenvalues(), e.eigenvectors()};
}

Eigenpairs lowest_eigenpairs(Vector diagonal, Vector off_diagonal, int count) {
  const int n = static_cast<int>(diagonal.size());
  count = std::min(count, n);
  if (count <= 0) return {};
  if (!diagonal.allFinite() || !off_diagonal.allFinite()) throw std::runtime_error("tridiagonal eigenvalues: not finite");
  off_diagonal.conservativeResize(n);  // dstevr uses one more for itself
  off_diagonal[n - 1] = 0;
  Vector values(n), work(20 * n);
  DenseMatrix vectors(n, count);
  std::vector<int> support(2 * static_cast<std::size_t>(count)), integers(10 * static_cast<std::size_t>(n));
  const int first = 1, lwork = 20 * n, liwork = 10 * n;
  const double unused = 0;
  int found = 0, info = 0;
  dstevr_("V", "I", &n, diagonal.data(), off_diagonal.data(), &unused, &unused, &first, &count, &unused, &found,
          values.data(), vectors.data(), &n, support.data(), work.data(), &lwork, integers.data(), &liwork, &info);
  if (info != 0 || found < count) throw std::runtime_error("tridiagonal eigenvalues: dstevr failed");
  return {values.head(count), vectors};
}

Eigenpairs3 eigenpairs3(const Eigen::Matrix3d& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> e(A);
  return {e.eigenvalues(), e.eigenvectors()};
}

Eigen::Vector3d eigenvalues3(const Eigen::Matrix3d& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

SingularFactors singular_factors(const DenseMatrix& A) {
  DenseMatrix tall = A;
  if (A.rows() < A.cols()) tall.conservativeResizeLike(DenseMatrix::Zero(A.cols(), A.cols()));
  const Eigen::JacobiSVD<DenseMatrix> svd(tall, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.matrixU().topRows(A.rows()), svd.singularValues(), svd.matrixV()};
}

PivotedFactors pivoted_factors(const DenseMatrix& A) {
  const Eigen::ColPivHouseholderQR<DenseMatrix> qr(A);
  const auto& order = qr.colsPermutation().indices();
  return {qr.matrixQR().diagonal(), {order.begin(), order.end()}};
}

DenseMatrix span(const DenseMatrix& A, double threshold) {
  const auto qr = pivoted<Eigen::ColPivHouseholderQR<DenseMatrix>>(A, threshold);
  return qr->householderQ() * DenseMatrix::Identity(A.rows(), qr->rank());
}

DenseMatrix complement(const Vector& e) {
  const DenseMatrix Q = Eigen::HouseholderQR<DenseMatrix>(e).householderQ();
  return Q.rightCols(e.size() - 1);
}

DenseMatrix least_squares(const DenseMatrix& A, const DenseMatrix& B) { return Eigen::ColPivHouseholderQR<DenseMatrix>(A).solve(B); }

Vector least_squares(const DenseMatrix& A, const Vector& b) { return Eigen::ColPivHouseholderQR<DenseMatrix>(A).solve(b); }

MinimumNorm::MinimumNorm(const DenseMatrix& A, std::optional<double> threshold)
    : factor_(pivoted<Eigen::CompleteOrthogonalDecomposition<DenseMatrix>>(A, threshold)) {}
Vector MinimumNorm::solve(const Vector& b) const { return factor_->solve(b); }
DenseMatrix MinimumNorm::solve(const DenseMatrix& B) const { return factor_->solve(B); }
Vector MinimumNorm::solve_transposed(const Vector& b) const { return factor_->transpose().solve(b); }

Ldlt::Ldlt(const DenseMatrix& A) : factor_(std::make_shared<Eigen::LDLT<DenseMatrix>>(A)) {}
double Ldlt::rcond() const { return factor_->rcond(); }
Vector Ldlt::solve(const Vector& b) const { return factor_->solve(b); }
DenseMatrix Ldlt::solve(const DenseMatrix& B) const { return factor_->solve(B); }

PivotedLu::PivotedLu(const DenseMatrix& A, std::optional<double> threshold) : factor_(pivoted<Eigen::FullPivLU<DenseMatrix>>(A, threshold)) {}
bool PivotedLu::regular() const { return rank() == factor_->cols(); }
int PivotedLu::rank() const { return static_cast<int>(factor_->rank()); }
Vector PivotedLu::solve(const Vector& b) const { return factor_->solve(b); }
DenseMatrix PivotedLu::kernel() const { return factor_->kernel(); }

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
