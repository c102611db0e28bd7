#include "algebra/condensation.hpp"

#include <Eigen/QR>

#include "algebra/dense.hpp"

namespace dotyk::algebra {

Condensation::Condensation(const SparseMatrix& K, const std::vector<int>& node,
                           const std::vector<int>& last, const DenseMatrix& kernel,
                           Ordering ordering)
    : factor_(K, node, last, ordering) {
  kernel_.resize(static_cast<Eigen::Index>(boundary().size()), kernel.cols());
  for (std::size_t k = 0; k < boundary().size(); ++k) kernel_.row(k) = kernel.row(boundary()[k]);
}

bool Condensation::factor(const SparseMatrix& K) {
  if (kernel_size() == 0) {
    if (!factor_.factor(K)) return false;
    l_gamma_ = factor_.boundary_factor();
    return true;
  }
  // Shift by the diagonal itself: of the size of the stiffness, so that taking it off again
  // loses a digit at most, and only on Γ.
  SparseMatrix shifted = K;
  Vector shift(boundary().size());
  for (std::size_t k = 0; k < boundary().size(); ++k) {
    double& diagonal = shifted.valuePtr()[K.outerIndexPtr()[boundary()[k]]];
    shift[k] = diagonal;
    diagonal += shift[k];
  }
  if (!factor_.factor(shifted)) return false;
  l_gamma_ = factor_.boundary_factor();
  l_dense_ = square(l_gamma_);
  l_dense_.diagonal() -= shift;
  const Eigen::HouseholderQR<DenseMatrix> qr(kernel_);
  const DenseMatrix basis =
      qr.householderQ() * DenseMatrix::Identity(kernel_.rows(), kernel_.cols());
  const double tau = shift.mean();
  l_dense_ += tau * basis * basis.transpose();
  return algebra::cholesky(l_dense_);
}

Vector Condensation::condense(const Vector& f) {
  swept_ = factor_.forward(f);
  return l_gamma_.triangularView<Eigen::Lower>() * factor_.boundary_part(swept_);
}

Vector Condensation::solve(const Vector& b) const {
  Vector x = b;
  solve_lower(dense_factor(), x);
  solve_lower_transposed(dense_factor(), x);
  return x;
}

DenseMatrix Condensation::half_compliance(const SparseRows& B) const {
  DenseMatrix x = DenseMatrix(B.transpose());
  solve_lower(dense_factor(), x);
  return x;
}

Vector Condensation::recover(const Vector& boundary_values) const {
  Vector swept = swept_;
  factor_.set_boundary_part(swept,
                            l_gamma_.transpose().triangularView<Eigen::Upper>() * boundary_values);
  return factor_.backward(swept);
}

}  // namespace dotyk::algebra
