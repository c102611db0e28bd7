#include "algebra/krylov/preconditioner.hpp"

#include <Eigen/Sparse>
#include <stdexcept>

#include "algebra/direct/sparse_sweeps.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::algebra {

Preconditioner::Preconditioner(const SparseMatrix& lower) : K_(lower) {
  if (lower.rows() != lower.cols() || !lower.isCompressed())
    throw std::logic_error("preconditioner: the matrix is not square or not compressed");
  for (int j = 0; j < lower.cols(); ++j) {
    const int first = lower.outerIndexPtr()[j];
    if (first == lower.outerIndexPtr()[j + 1] || lower.innerIndexPtr()[first] != j || !(lower.valuePtr()[first] > 0))
      throw InputError(text("the matrix is not positive definite: the diagonal entry of unknown ", j + 1, " is not positive"));
  }
}

DenseMatrix Preconditioner::times(const Eigen::Ref<const DenseMatrix>& v) const {
  return K_.selfadjointView<Eigen::Lower>() * v;
}

Ssor::Ssor(const SparseMatrix& lower, double omega) : Preconditioner(lower), omega_(omega), d_(lower.rows()) {
  if (!(omega > 0 && omega < 2)) throw InputError(text("SSOR's omega is ", omega, "; it must be between 0 and 2"));
  for (int j = 0; j < lower.cols(); ++j) d_[j] = lower.valuePtr()[lower.outerIndexPtr()[j]] / omega;
  root_ = d_.cwiseSqrt();
}

DenseMatrix Ssor::apply(const Eigen::Ref<const DenseMatrix>& v) const {
  DenseMatrix w = root_.asDiagonal() * v, t = w;
  sweep_backward(K_, d_, t);
  w.noalias() -= ((2 - omega_) * d_).asDiagonal() * t;
  sweep_forward(K_, d_, w);
  return root_.asDiagonal() * (t + w);
}

DenseMatrix Ssor::forward(const Eigen::Ref<const DenseMatrix>& b) const {
  DenseMatrix x = b;
  sweep_forward(K_, d_, x);
  return root_.asDiagonal() * x;
}

DenseMatrix Ssor::backward(const Eigen::Ref<const DenseMatrix>& x) const {
  DenseMatrix y = root_.asDiagonal() * x;
  sweep_backward(K_, d_, y);
  return y;
}

DenseMatrix Ssor::lift(const Eigen::Ref<const DenseMatrix>& r) const {
  DenseMatrix y = root_.cwiseInverse().asDiagonal() * r;
  multiply_lower(K_, d_, y);
  return y;
}

std::unique_ptr<Preconditioner> make_preconditioner(Preconditioning kind, const SparseMatrix& lower, double omega) {
  switch (kind) {
    case Preconditioning::none: return std::make_unique<NoPreconditioner>(lower);
    case Preconditioning::ssor: return std::make_unique<Ssor>(lower, omega);
    default: return std::make_unique<IncompleteCholesky>(lower);
  }
}

}  // namespace dotyk::algebra
