#include "algebra/dense/generalised_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/dense/null_space.hpp"
#include "base/error.hpp"

namespace dotyk::algebra {

namespace {

/// Exchanges one unknown for another while that makes |det R_F| grow, by at least a tenth each time.
void exchange(const DenseMatrix& kernel, std::vector<int>& unknowns) {
  for (int round = 0; round < 100; ++round) {
    const DenseMatrix held = kernel(unknowns, Eigen::all);
    // (R R_F⁻¹)_ik: by what |det R_F| is multiplied when unknown i takes the place of F's k-th.
    const DenseMatrix gain = Lu(held).solve_transposed(DenseMatrix(kernel.transpose()));
    Eigen::Index k, i;
    if (!(gain.cwiseAbs().maxCoeff(&k, &i) > 1.1)) return;
    unknowns[k] = static_cast<int>(i);
  }
}

}  // namespace

std::vector<int> fixing_unknowns(const DenseMatrix& kernel) {
  std::vector<int> unknowns;
  if (kernel.size() == 0) return unknowns;
  unknowns = pivoted_factors(orthonormal(kernel).transpose()).order;
  unknowns.resize(kernel.cols());
  exchange(kernel, unknowns);
  return unknowns;
}

std::vector<int> fixing_unknowns(const SparseMatrix& kernel) {
  std::vector<int> unknowns;
  for (const Piece& piece : pieces(kernel))
    for (const int k : fixing_unknowns(dense(kernel, piece))) unknowns.push_back(piece.rows[k]);
  return unknowns;
}

Vector kernel_residual(const SymmetricMatrix& K, const DenseMatrix& R) {
  Vector result = Vector::Zero(R.cols());
  if (R.cols() == 0) return result;
  const Vector rows = K.gross_times(Vector::Ones(K.rows()));
  for (Eigen::Index k = 0; rows.size() > 0 && k < R.cols(); ++k) {
    const Vector force = K.times(Vector(R.col(k)));
    for (Eigen::Index i = 0; i < rows.size(); ++i)
      if (rows[i] > 0) result[k] = std::max(result[k], std::abs(force[i]) / rows[i]);
    result[k] /= R.col(k).lpNorm<Eigen::Infinity>();
  }
  return result;
}

SparseMatrix hold(SparseMatrix lower, const std::vector<int>& unknowns) {
  std::vector<char> is_fixed(lower.rows(), 0);
  for (int unknown : unknowns) is_fixed[unknown] = 1;
  const double largest = lower.rows() > 0 ? Vector(lower.diagonal()).maxCoeff() : 0;
  for (int j = 0; j < lower.cols(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
      if (is_fixed[it.row()] || is_fixed[j]) it.valueRef() = it.row() != j ? 0 : largest > 0 ? largest : 1;
  return lower;
}

GeneralisedInverse::GeneralisedInverse(const SparseMatrix& lower, const std::vector<int>& node,
                                       const DenseMatrix& kernel, std::vector<int> fixed, Ordering ordering)
    : fixed_(std::move(fixed)), basis_(orthonormal(kernel)), factor_(lower, node, {}, ordering) {
  if (static_cast<Eigen::Index>(fixed_.size()) != basis_.cols())
    throw InputError(text(fixed_.size(), " unknowns are fixed; the kernel has ", basis_.cols(), " motions"));
  regularity_ = fixed_.empty() ? 1 : smallest_singular_value(basis_(fixed_, Eigen::all));
  // Of ‖K⁺‖'s bound 1/regularity² no digit would be left.
  if (!(regularity_ > 1e-8)) throw InputError("the unknowns fixed do not hold every motion of the kernel");
}

GeneralisedInverse::GeneralisedInverse(const SparseMatrix& lower, const std::vector<int>& node,
                                       const DenseMatrix& kernel, Ordering ordering)
    : GeneralisedInverse(lower, node, kernel, fixing_unknowns(kernel), ordering) {}

bool GeneralisedInverse::factor(const SparseMatrix& lower) {
  return factor_.factor(fixed_.empty() ? lower : hold(lower, fixed_));
}

DenseMatrix GeneralisedInverse::apply(const DenseMatrix& f) const {
  if (fixed_.empty()) return factor_.solve(f);
  DenseMatrix held = f;
  held(fixed_, Eigen::all).setZero();
  return factor_.solve(held);
}

}  // namespace dotyk::algebra
