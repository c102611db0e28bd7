#include "shape/optimise/bordered.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dotyk::shape {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

constexpr double kSingular = 1e-14;   ///< reciprocal condition of the scaled matrix
constexpr double kDependent = 1e-11;  ///< pivots below are dependent rows; as in the steps of PDAS
constexpr double kAgreed = 1e-8;      ///< relative residual up to which dependent rows agree

/// Unit diagonal where y is, unit greatest entries of α's columns.
Vector scaling(const Bordered& bordered) {
  const Eigen::Index n = bordered.unknowns, all = bordered.A.rows();
  Vector scale = Vector::Ones(all);
  if (n == 0) return scale;
  const double greatest = bordered.A.diagonal().head(n).maxCoeff();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double d = bordered.A(j, j);
    scale[j] = 1 / std::sqrt(d > kSingular * greatest ? d : greatest > 0 ? greatest : 1);
  }
  for (Eigen::Index k = n; k < all; ++k) {
    const double size = scale.head(n).cwiseProduct(bordered.A.col(k).head(n)).cwiseAbs().maxCoeff();
    if (size > 0) scale[k] = 1 / size;
  }
  return scale;
}

void require_agreement(const Vector& left, const Vector& right) {
  if (!left.allFinite() || (left - right).norm() > kAgreed * right.norm())
    throw InputError("the conditions in contact contradict each other as nodes move, or do not hold a body: the solution has no "
                     "derivative along this motion");
}

}  // namespace

Bordered::Bordered(const problem::CondensedProblem& condensed, const LawDerivative& law) : unknowns(law.size()) {
  const Eigen::Index n = unknowns, modes = condensed.kernel_size();
  A = DenseMatrix::Zero(n + modes, n + modes);
  if (n == 0) return;
  const DenseMatrix WE = condensed.W() * law.E;
  A.topLeftCorner(n, n) = law.F.transpose() * WE;
  A.topLeftCorner(n, n).diagonal() += law.C;
  if (modes == 0) return;
  A.topRightCorner(n, modes) = -(law.F.transpose() * condensed.N());
  A.bottomLeftCorner(modes, n) = (law.E.transpose() * condensed.N()).transpose();
}

Bordered Bordered::restricted(const std::vector<int>& kept) const {
  std::vector<int> index = kept;
  for (Eigen::Index k = unknowns; k < A.rows(); ++k) index.push_back(static_cast<int>(k));
  return {A(index, index), static_cast<int>(kept.size())};
}

BorderedFactor::BorderedFactor(const Bordered& bordered) : scale_(scaling(bordered)) {
  A_ = scale_.asDiagonal() * bordered.A * scale_.asDiagonal();
  if (A_.rows() == 0) return;
  lu_ = algebra::Lu(A_);
  if (lu_.rcond() >= kSingular) return;
  dependent_.emplace(A_, kDependent);
}

Vector BorderedFactor::solve(const Vector& b) const {
  if (A_.rows() == 0) return b;
  const Vector scaled = scale_.cwiseProduct(b);
  const Vector y = dependent_ ? dependent_->solve(scaled) : lu_.solve(scaled);
  require_agreement(A_ * y, scaled);
  return scale_.cwiseProduct(y);
}

Vector BorderedFactor::solve_transposed(const Vector& b) const {
  if (A_.rows() == 0) return b;
  const Vector scaled = scale_.cwiseProduct(b);
  const Vector y = dependent_ ? dependent_->solve_transposed(scaled) : lu_.solve_transposed(scaled);
  require_agreement(A_.transpose() * y, scaled);
  return scale_.cwiseProduct(y);
}

}  // namespace dotyk::shape
