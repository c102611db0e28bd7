#include "algebra/dense/decompositions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

extern "C" void dstevr_(const char* jobz, const char* range, const int* n, double* d, double* e, const double* vl,
                        const double* vu, const int* il, const int* iu, const double* abstol, int* m, double* w,
                        double* z, const int* ldz, int* isuppz, double* work, const int* lwork, int* iwork,
                        const int* liwork, int* info);

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

}  // namespace dotyk::algebra
