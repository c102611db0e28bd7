#include "solver/feti/coarse_space.hpp"

#include "algebra/dense/decompositions.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Added to C's unit diagonal so that it is positive definite: far above rounding, far below what coarse problems have
/// for least eigenvalue.
constexpr double kShift = 1e-12;
/// A pivot below it may belong to a motion that no row notices (theirs are about kShift times the square of the motion
/// over that of its mode); whether it does, its jump tells.
constexpr double kSmallPivot = 1e-6;
/// The jump G̃ᵀz of a motion z that rows do not notice, relative to its parts: 1e-15 by rounding. The square of that of
/// noticed ones is an eigenvalue of C.
constexpr double kUnnoticed = 1e-9;
/// G̃w − r relative to r that is rounding, and the part of the last one that another correction must leave.
constexpr double kBalancedMotions = 1e-14, kWorthwhile = 0.1;
/// The jump of one mode, of norm one as the rows are, that is rounding: no row notices it.
constexpr double kNoJump = 1e-13;

constexpr int kLanczosSteps = 60;
/// A part of a unit vector in im P below it is rounding.
constexpr double kNoPart = 1e-10;

algebra::Cholesky analysed(const SparseMatrix& lower) {
  std::vector<int> node(lower.rows());
  std::iota(node.begin(), node.end(), 0);
  return {lower, node, {}};
}

/// Factors C with modes held, and with further ones where it is singular still.
void factor_held(HeldFactor& factor, const SparseMatrix& C, std::vector<int>& held) {
  while (!factor.factor(C, held)) {
    const int mode = factor.failed_unknown();
    if (mode < 0 || std::find(held.begin(), held.end(), mode) != held.end())
      throw std::runtime_error("the coarse space: its matrix has no factor");
    held.push_back(mode);
  }
}

/// Modes that hold every motion z with Cz = 0, and perhaps some more.
std::vector<int> candidates(HeldFactor& factor, const SparseMatrix& C) {
  SparseMatrix shifted = C;
  for (int j = 0; j < C.cols(); ++j) shifted.coeffRef(j, j) += kShift;
  std::vector<int> modes;
  factor_held(factor, shifted, modes);
  const Vector pivots = factor.pivots();
  for (int j = 0; j < C.cols(); ++j)
    if (pivots[j] < kSmallPivot && std::find(modes.begin(), modes.end(), j) == modes.end()) modes.push_back(j);
  return modes;
}

/// The motions in which one of the modes has the amount 1, the other ones 0 and the rest follow so that they jump as
/// little as they can: modes × modes.size(), columns of norm one. `factor`: of C with the modes held.
DenseMatrix least_jumps(const HeldFactor& factor, const SparseMatrix& C, const std::vector<int>& modes) {
  DenseMatrix force(C.rows(), modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k)
    force.col(k) = -(C.selfadjointView<Eigen::Lower>() * Vector::Unit(C.rows(), modes[k]));
  DenseMatrix z = factor.solve(std::move(force));
  for (std::size_t k = 0; k < modes.size(); ++k) z(modes[k], k) = 1;
  return z.colwise().normalized();
}

/// Those of the modes that are left when as many as jump independently of each other are taken away.
std::vector<int> unnoticed(const DenseMatrix& jumps, const std::vector<int>& modes) {
  if (jumps.size() == 0) return modes;
  const auto [pivots, order] = algebra::pivoted_factors(jumps);
  const auto rank = (pivots.array().abs() > kUnnoticed).count();
  std::vector<int> left;
  for (Eigen::Index k = rank; k < jumps.cols(); ++k) left.push_back(modes[order[k]]);
  return left;
}

}  // namespace

HeldFactor::HeldFactor(const SparseMatrix& lower) : factor_(analysed(lower)) {}

bool HeldFactor::factor(const SparseMatrix& lower, const std::vector<int>& held) {
  held_ = held;
  return factor_.factor(algebra::hold(lower, held));
}

DenseMatrix HeldFactor::solve(DenseMatrix right) const {
  right(held_, Eigen::all).setZero();
  return factor_.solve(right);
}

CoarseSpace::CoarseSpace(const SparseMatrix& G, Vector e) : G_(G), scale_(Vector::Zero(G.rows())), e_(std::move(e)) {
  particular_ = Vector::Zero(G.cols());
  if (modes() == 0) return;
  for (int r = 0; r < G.cols(); ++r)
    for (SparseMatrix::InnerIterator it(G, r); it; ++it) scale_[it.row()] += it.value() * it.value();
  scale_ = scale_.unaryExpr([](double s) { return s > kNoJump * kNoJump ? 1 / std::sqrt(s) : 0.0; });
  G_ = scale_.asDiagonal() * G_;
  SparseMatrix& C = C_ = SparseMatrix(G_ * SparseMatrix(G_.transpose())).triangularView<Eigen::Lower>();
  for (int j = 0; j < modes(); ++j) C.coeffRef(j, j) += 0;  // an entry for modes that no row notices
  C.makeCompressed();

  factor_.emplace(C);
  held_ = candidates(*factor_, C);
  factor_held(*factor_, C, held_);
  if (!held_.empty()) {
    const DenseMatrix jumps = G_.transpose() * least_jumps(*factor_, C, held_);
    held_ = unnoticed(jumps, held_);
    factor_held(*factor_, C, held_);
  }
  std::sort(held_.begin(), held_.end());

  particular_ = balancing(scale_.cwiseProduct(e_));
}

Vector CoarseSpace::unbalanced(const Vector& lambda) const {
  if (modes() == 0) return {};
  return e_ - Vector(G_ * lambda).cwiseQuotient(scale_.unaryExpr([](double s) { return s > 0 ? s : 1.0; }));
}

double CoarseSpace::imbalance() const {
  const double size = e_.stableNorm();
  return size > 0 ? unbalanced(particular_).stableNorm() / size : 0;
}

Vector CoarseSpace::balancing(const Vector& scaled) const {
  Vector w = G_.transpose() * factor_->solve(scaled);
  double last = scaled.norm();
  for (;;) {
    Vector left = scaled - G_ * w;
    left(held_).setZero();
    const double size = left.norm();
    if (!(size > kBalancedMotions * scaled.norm() && size < kWorthwhile * last)) return w;
    w += G_.transpose() * factor_->solve(left);
    last = size;
  }
}

Vector CoarseSpace::Q(const Vector& v) const {
  if (modes() == 0) return Vector::Zero(v.size());
  return balancing(G_ * v);
}

Vector CoarseSpace::P(const Vector& v) const { return v - Q(v); }

Vector CoarseSpace::amounts(const Vector& v) const {
  if (modes() == 0) return {};
  return scale_.cwiseProduct(factor_->solve(G_ * v).col(0));
}

algebra::SpectrumEnds dual_spectrum(const DualProblem& dual, const CoarseSpace& coarse, algebra::Ends ends,
                                    Monitor& monitor) {
  const Vector start = coarse.P(coarse.P(algebra::lanczos_start(dual.rows())));
  if (!(start.norm() > kNoPart)) return {};
  // What rounding brings in of im Q shall have an eigenvalue amid the others, not 0.
  const double middle = start.dot(dual.apply(start)) / start.squaredNorm();
  const auto PFP = [&](const Vector& v) -> Vector {
    monitor.check();
    const Vector Pv = coarse.P(v);
    return coarse.P(dual.apply(Pv)) + middle * (v - Pv);
  };
  return algebra::lanczos(PFP, start, kLanczosSteps, ends);
}

}  // namespace dotyk::solver
