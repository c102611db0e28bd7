#include "shape/derivative/bordered.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "problem/measure.hpp"
#include "program/active_set.hpp"

namespace dotyk::shape {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::FrictionGroup;
using problem::Law;
using problem::Problem;
using problem::RowGroup;

/// What is nothing, row by row; and what were nothing but for the multipliers' errors.
struct Nothing {
  Nothing(const Problem& problem, const Vector& lambda, const Vector& x, double touching, double force_error) {
    const problem::Measure measure(problem);
    exact_force = measure.nothing(touching, lambda, x).force;
    force = exact_force.cwiseMax(force_error);
    gap = force.cwiseQuotient(measure.stiffness());
  }
  Vector force, gap, exact_force;
};

class Branches {
 public:
  Branches(const Problem& problem, const problem::State& state, double touching, double force_error)
      : problem_(problem), lambda_(state.lambda), x_(problem::jumps(problem, state.u)),
        nothing_(problem, lambda_, x_, touching, force_error), unknown_(problem.rows(), -1), weak_(problem.rows(), 0) {}

  LawDerivative operator()() {
    for (const RowGroup& group : problem_.groups)
      for (int i = 0; i < group.count; ++i) scalar(group, i);
    for (const FrictionGroup& group : problem_.friction)
      for (int p = 0; p < group.points(); ++p) friction(group, p);
    const int count = static_cast<int>(compliance_.size());
    result_.C = Eigen::Map<const Vector>(compliance_.data(), count);
    result_.F.resize(problem_.rows(), count);
    result_.F.setFromTriplets(measured_.begin(), measured_.end());
    measured_.insert(measured_.end(), following_.begin(), following_.end());
    result_.E.resize(problem_.rows(), count);
    result_.E.setFromTriplets(measured_.begin(), measured_.end());
    result_.symmetric = following_.empty();
    return std::move(result_);
  }

 private:
  /// A new unknown in this direction of rows; returns it.
  int add(int row, const Vector& direction, double compliance) {
    const int j = static_cast<int>(compliance_.size());
    for (int i = 0; i < direction.size(); ++i) measured_.emplace_back(row + i, j, direction[i]);
    compliance_.push_back(compliance);
    return j;
  }
  int add(int row, double sign, double stiffness) {
    return add(row, Vector::Constant(1, sign), std::isinf(stiffness) ? 0 : 1 / stiffness);
  }

  void scalar(const RowGroup& group, int i) {
    const int r = group.first + i;
    const Law& law = *group.law;
    const auto [low, high] = law.multipliers(i);
    if (low == high) return;
    if (!law.springs(i)) throw InputError(text(group.name, ": the ", law.name(), " law does not tell its springs; there is no derivative of its solutions"));
    const problem::Springs springs = *law.springs(i);
    const bool at_low = lambda_[r] - low <= nothing_.force[r], at_high = high - lambda_[r] <= nothing_.force[r];
    if (!at_low && !at_high) {
      if (springs.below != springs.above && std::abs(lambda_[r]) <= nothing_.force[r])
        throw InputError(text(group.name, ": the ", law.name(), " law of ", problem_.name_of(r),
                              " bears nothing and changes its stiffness there; the solution has no derivative"));
      unknown_[r] = add(r, 1, lambda_[r] < 0 ? springs.below : springs.above);
      return;
    }
    const auto [from, to] = problem::following(law, i);
    if (at_low ? x_[r] < from - nothing_.gap[r] : x_[r] > to + nothing_.gap[r]) return;
    require_precise(r, at_low ? lambda_[r] - low : high - lambda_[r], at_low ? from - x_[r] : x_[r] - to);
    weak_[r] = 1;
    unknown_[r] = at_low ? add(r, 1, springs.above) : add(r, -1, springs.below);
    result_.weak.push_back(unknown_[r]);
    result_.weak_row.push_back(r);
  }

  /// Is it the solution, and not its error, that makes force and gap nothing?
  void require_precise(int r, double force, double gap) const {
    const double ratio = nothing_.exact_force[r] / nothing_.force[r];
    if (force <= nothing_.exact_force[r] && gap <= ratio * nothing_.gap[r]) return;
    throw InputError(text("the solution is not precise enough to tell whether ", problem_.name_of(r), " presses: force ", force, ", multipliers are wrong by up to ",
                          nothing_.force[r], "; solve with a smaller tol, or by pdas or newton"));
  }

  void friction(const FrictionGroup& group, int p) {
    const int r = group.row(p), m = group.components, n = group.normal[p];
    const double slope = n < 0 ? 0 : group.law->bound_slope(p), bound = group.bound(p, lambda_);
    const Vector lambda = lambda_.segment(r, m), slip = x_.segment(r, m);
    const double force = nothing_.force.segment(r, m).maxCoeff(), gap = nothing_.gap.segment(r, m).maxCoeff();
    if (slope > 0 && weak_[n])
      throw InputError(text(group.name, ": ", problem_.name_of(r), " touches without force, where its friction begins; the solution "
                            "has no derivative with Coulomb friction there"));
    if (slope > 0 && (unknown_[n] < 0 || lambda_[n] < -nothing_.force[n])) return;  // open, or pulled: no friction
    if (slope > 0 && lambda_[n] <= nothing_.force[n])
      throw InputError(text(group.name, ": ", problem_.name_of(r), " bears nothing, where its friction begins; the solution has no derivative with Coulomb friction there"));
    if (lambda.norm() < bound - force) {
      for (int i = 0; i < m; ++i) add(r + i, 1, Law::kUnbounded);
      return;
    }
    if (slip.norm() <= gap && slip.norm() > gap * nothing_.exact_force[r] / nothing_.force[r])
      throw InputError(text("the solution is not precise enough to tell whether ", problem_.name_of(r), " slips: slip ", slip.norm(),
                            "; solve with a smaller tol, or by newton"));
    if (slip.norm() <= gap)
      throw InputError(text(group.name, ": ", problem_.name_of(r), " bears all its friction bound ", bound, " and does not slip: "
                            "to one side it sticks, to the other it slips; the solution has no derivative there"));
    slips(r, slip, bound);
    if (slope == 0) {
      result_.slips.push_back({r, slip / slip.norm()});
      return;
    }
    for (int i = 0; i < m; ++i) following_.emplace_back(r + i, unknown_[n], slope * slip[i] / slip.norm());
  }

  /// In space the force b d turns with the slip: (b/‖x‖)(I − ddᵀ) x', a spring across d.
  void slips(int row, const Vector& slip, double bound) {
    if (slip.size() == 1) return;
    add(row, Eigen::Vector2d(-slip[1], slip[0]) / slip.norm(), slip.norm() / bound);
  }

  const Problem& problem_;
  const Vector& lambda_;
  Vector x_;
  Nothing nothing_;
  std::vector<int> unknown_;  ///< of each scalar row, -1 where it has none
  std::vector<char> weak_;    ///< of each row
  std::vector<Eigen::Triplet<double>> measured_, following_;
  std::vector<double> compliance_;
  LawDerivative result_;
};

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

LawDerivative law_derivative(const Problem& problem, const problem::State& state, double touching, double force_error) {
  return Branches(problem, state, touching, force_error)();
}

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
