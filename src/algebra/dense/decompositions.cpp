#include "algebra/dense/decompositions.hpp"

#include <Eigen/Dense>

namespace dotyk::algebra {
namespace {

/// A decomposition of A that takes pivots below `threshold` of the greatest for zero.
template <class Decomposition>
Decomposition pivoted(const DenseMatrix& A, std::optional<double> threshold) {
  Decomposition d;
  if (threshold) d.setThreshold(*threshold);
  d.compute(A);
  return d;
}

}  // namespace

Eigenpairs eigenpairs(const DenseMatrix& A) {
  const Eigen::SelfAdjointEigenSolver<DenseMatrix> e(A);
  return {e.eigenvalues(), e.eigenvectors()};
}

Vector eigenvalues(const DenseMatrix& A) { return Eigen::SelfAdjointEigenSolver<DenseMatrix>(A, Eigen::EigenvaluesOnly).eigenvalues(); }

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
  return qr.householderQ() * DenseMatrix::Identity(A.rows(), qr.rank());
}

DenseMatrix complement(const Vector& e) {
  const DenseMatrix Q = Eigen::HouseholderQR<DenseMatrix>(e).householderQ();
  return Q.rightCols(e.size() - 1);
}

DenseMatrix least_squares(const DenseMatrix& A, const DenseMatrix& B) { return Eigen::ColPivHouseholderQR<DenseMatrix>(A).solve(B); }

Vector least_squares(const DenseMatrix& A, const Vector& b) { return Eigen::ColPivHouseholderQR<DenseMatrix>(A).solve(b); }

struct MinimumNorm::Factor {
  Eigen::CompleteOrthogonalDecomposition<DenseMatrix> cod;
};
MinimumNorm::MinimumNorm(const DenseMatrix& A, std::optional<double> threshold)
    : factor_(std::make_shared<Factor>(Factor{pivoted<decltype(Factor::cod)>(A, threshold)})) {}
Vector MinimumNorm::solve(const Vector& b) const { return factor_->cod.solve(b); }
DenseMatrix MinimumNorm::solve(const DenseMatrix& B) const { return factor_->cod.solve(B); }
Vector MinimumNorm::solve_transposed(const Vector& b) const { return factor_->cod.transpose().solve(b); }

struct Ldlt::Factor {
  Eigen::LDLT<DenseMatrix> ldlt;
};
Ldlt::Ldlt(const DenseMatrix& A) : factor_(std::make_shared<Factor>(Factor{Eigen::LDLT<DenseMatrix>(A)})) {}
bool Ldlt::factored() const { return factor_->ldlt.info() == Eigen::Success; }
double Ldlt::rcond() const { return factor_->ldlt.rcond(); }
Vector Ldlt::solve(const Vector& b) const { return factor_->ldlt.solve(b); }
DenseMatrix Ldlt::solve(const DenseMatrix& B) const { return factor_->ldlt.solve(B); }

struct PivotedLu::Factor {
  Eigen::FullPivLU<DenseMatrix> lu;
};
PivotedLu::PivotedLu(const DenseMatrix& A, std::optional<double> threshold)
    : factor_(std::make_shared<Factor>(Factor{pivoted<decltype(Factor::lu)>(A, threshold)})), size_(static_cast<int>(A.cols())) {}
int PivotedLu::rank() const { return static_cast<int>(factor_->lu.rank()); }
Vector PivotedLu::solve(const Vector& b) const { return factor_->lu.solve(b); }
DenseMatrix PivotedLu::kernel() const { return factor_->lu.kernel(); }

}  // namespace dotyk::algebra
