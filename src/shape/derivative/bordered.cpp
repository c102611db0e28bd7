#include "shape/derivative/bordered.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "program/active_set.hpp"

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

constexpr double kWrong = 1e-8;  ///< relative, of signs in weak contact
constexpr double kNone = std::numeric_limits<double>::infinity();

/// The program in ŷ = y/(σ d): H gets a unit diagonal, the right side is of size 1.
program::QuadraticProgram program_of(const Bordered& bordered, const std::vector<int>& weak, const Vector& b) {
  const Eigen::Index n = bordered.unknowns, modes = bordered.A.rows() - n;
  const DenseMatrix H = bordered.A.topLeftCorner(n, n);
  const double greatest = H.diagonal().maxCoeff();
  Vector d(n);
  for (Eigen::Index j = 0; j < n; ++j) d[j] = 1 / std::sqrt(H(j, j) > 1e-14 * greatest ? H(j, j) : greatest);
  DenseMatrix A = DenseMatrix::Zero(modes + n, n);
  A.topRows(modes) = bordered.A.bottomLeftCorner(modes, n) * d.asDiagonal();
  Vector e = b.tail(modes), g = d.cwiseProduct(b.head(n));
  for (Eigen::Index k = 0; k < modes; ++k) {
    const double size = A.row(k).cwiseAbs().maxCoeff();
    if (size > 0) A.row(k) /= size, e[k] /= size;
  }
  double sigma = g.lpNorm<Eigen::Infinity>();
  if (modes > 0) sigma = std::max(sigma, e.lpNorm<Eigen::Infinity>());
  if (!(sigma > 0)) sigma = 1;
  A.bottomRows(n).setIdentity();
  program::QuadraticProgram p;
  p.P = DenseMatrix(DenseMatrix(d.asDiagonal() * H * d.asDiagonal()).triangularView<Eigen::Lower>()).sparseView();
  p.q = -g / sigma;
  p.A = A.sparseView();
  p.low = Vector::Constant(modes + n, -kNone);
  p.high = Vector::Constant(modes + n, kNone);
  p.low.head(modes) = p.high.head(modes) = e / sigma;
  for (const int j : weak) p.low[modes + j] = 0;
  return p;
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

std::vector<int> closing(const Bordered& bordered, const std::vector<int>& weak, const Vector& b, Monitor& monitor) {
  const program::QuadraticProgram program = program_of(bordered, weak, b);
  const program::Result result = program::solve(program, program::ActiveSet{}, monitor);
  if (result.status == program::Status::infeasible || result.status == program::Status::unbounded)
    throw InputError("in weak contact (touching without force) along this motion of the nodes the solution has no derivative: " + result.reason);
  std::vector<char> kept(static_cast<std::size_t>(bordered.unknowns), 1);
  const Eigen::Index modes = bordered.A.rows() - bordered.unknowns;
  for (const int j : weak)
    if (result.working[static_cast<std::size_t>(modes + j)] == program::Side::low) kept[static_cast<std::size_t>(j)] = 0;
  std::vector<int> all;
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (kept[j]) all.push_back(static_cast<int>(j));
  return all;
}

void require_complementary(const Bordered& bordered, const std::vector<int>& weak, const Vector& b, const Vector& solved) {
  const Eigen::Index n = bordered.unknowns;
  const Vector open = (bordered.A * solved - b).head(n);  // Cy − Fᵀx'
  Vector d = bordered.A.diagonal().head(n).cwiseSqrt();
  d = d.cwiseMax(1e-7 * d.maxCoeff());
  const double size = std::max(d.cwiseProduct(solved.head(n)).lpNorm<Eigen::Infinity>(), b.head(n).cwiseQuotient(d).lpNorm<Eigen::Infinity>());
  for (const int j : weak)
    if (std::min(solved[j] * d[j], open[j] / d[j]) < -kWrong * size)
      throw std::runtime_error("the quadratic program of weak contact did not settle");
}

}  // namespace dotyk::shape
