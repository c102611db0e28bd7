#include "algebra/dense/decompositions.hpp"

#include <Eigen/Dense>

namespace dotyk::algebra {

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
  const Eigen::JacobiSVD<DenseMatrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

PivotedFactors pivoted_factors(const DenseMatrix& A) {
  const Eigen::ColPivHouseholderQR<DenseMatrix> qr(A);
  const auto& order = qr.colsPermutation().indices();
  return {qr.matrixQR().diagonal(), {order.begin(), order.end()}};
}

DenseMatrix span(const DenseMatrix& A, double threshold) {
  Eigen::ColPivHouseholderQR<DenseMatrix> qr(A);
  qr.setThreshold(threshold);
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
MinimumNorm::MinimumNorm(const DenseMatrix& A, std::optional<double> threshold) {
  auto factor = std::make_shared<Factor>();
  if (threshold) factor->cod.setThreshold(*threshold);
  factor->cod.compute(A);
  factor_ = std::move(factor);
}
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
PivotedLu::PivotedLu(const DenseMatrix& A, std::optional<double> threshold) : size_(static_cast<int>(A.cols())) {
  auto factor = std::make_shared<Factor>();
  if (threshold) factor->lu.setThreshold(*threshold);
  factor->lu.compute(A);
  factor_ = std::move(factor);
}
int PivotedLu::rank() const { return static_cast<int>(factor_->lu.rank()); }
Vector PivotedLu::solve(const Vector& b) const { return factor_->lu.solve(b); }
DenseMatrix PivotedLu::kernel() const { return factor_->lu.kernel(); }

}  // namespace dotyk::algebra
