#include "solver/core/friction_bound.hpp"

#include <numbers>

#include "algebra/dense/decompositions.hpp"
#include "program/interior_point.hpp"
#include "problem/measure.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionGroup;
using problem::Problem;

constexpr int kMostBoundRows = 600;  // the programs are dense
constexpr int kSides = 16;           // of the polygon around a disc
constexpr double kParallel = 1e-8, kProved = 1e-6;  // relative

/// Rows scaled by √ρ, so that the forces and displacements of all have one unit.
class FrictionPrograms {
 public:
  FrictionPrograms(const Problem& problem, const CondensedProblem& condensed, const FrictionalMotion& motion)
      : problem_(problem), root_(problem::Measure(problem, condensed).stiffness().cwiseSqrt()), W_(root_.asDiagonal() * condensed.W() * root_.asDiagonal()),
        x0_(root_.cwiseProduct(condensed.x0())), N_(root_.asDiagonal() * DenseMatrix(motion.rigid.noticed_N)), e_(motion.rigid.noticed_e),
        slip_(motion.rigid.N * motion.amounts), work_(motion.work) {
    treatable_ = add_laws() && add_friction();
  }

  bool prove(Monitor& monitor) {
    if (!treatable_ || !parallel()) return false;
    const std::optional<double> lowest = least(DenseMatrix::Zero(W_.rows(), W_.rows()), Vector::Zero(W_.rows()), 0, monitor);
    if (!lowest || monitor.stop()) return false;
    // Both in the unit of an energy. A margin makes the bound safe from the tolerance of the programs.
    const double kappa = *lowest - kProved * size_;
    const Vector c = slipping_.transpose() * root_.cwiseProduct(slip_) / work_;
    const std::optional<double> value = least(slipping_, kappa * c, -kappa, monitor);
    return value && *value > kProved * size_;
  }

 private:
  bool add_laws() {
    pushes_.assign(problem_.rows(), 0);
    for (const auto& [law, k, r] : problem_.scalar_rows()) {
      const auto stiffness = law.linear_stiffness(k);
      if (law.unilateral()) pushes_[r] = 1, limit({{r, 1.0}});
      else if (!stiffness) return false;
      else if (std::isfinite(*stiffness)) W_(r, r) += root_[r] * root_[r] / *stiffness;  // λ_r x_r = λ_r²/k
    }
    return W_.allFinite();
  }

  bool add_friction() {
    slipping_ = DenseMatrix::Zero(W_.rows(), W_.rows());
    for (const auto& [group, k, t, n] : problem_.friction_points()) {
      const double mu = group.law->bound_slope(k);
      if (group.law->bound(k, 0) > 0 || (mu > 0 && (n < 0 || !pushes_[n]))) return false;
      add_point(n, t, group.components, mu);
    }
    return true;
  }

  /// The polygon around the disc of friction, and μ s of the point.
  void add_point(int n, int t, int components, double mu) {
    if (!(mu > 0)) {
      for (int i = 0; i < components; ++i) limit({{t + i, 1.0}}), limit({{t + i, -1.0}});
      return;
    }
    const double factor = root_[n] / root_[t];  // a point has one ρ along its tangents
    if (components == 1) {
      for (const double side : {1.0, -1.0}) limit({{n, mu * factor}, {t, side}});
    } else {
      for (int k = 0; k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        limit({{n, mu * root_[n]}, {t, std::cos(angle) * root_[t]}, {t + 1, std::sin(angle) * root_[t + 1]}});
      }
    }
    if (const double length = slip_.segment(t, components).norm(); length > problem::kNotAtAll)
      for (int i = 0; i < components; ++i) slipping_(t + i, n) = mu * root_[n] / root_[t + i] * slip_[t + i] / length;
  }

  /// Adds the inequality Σ value · λ_column ≥ 0, over the entries of the row.
  void limit(const std::vector<std::pair<int, double>>& row) {
    for (const auto& [column, value] : row) limits_.emplace_back(count_, column, value);
    ++count_;
  }

  /// True if NᵀSλ = N_tᵀ(μsp) is a multiple of e for all forces in balance. The condition is qᵀNᵀSλ = 0 for each motion q ⟂ e. Forces in
  /// balance have qᵀNᵀλ = qᵀe = 0, so it holds if SᵀNq is a combination of the columns of NQ, Q a basis of these motions.
  bool parallel() const {
    if (e_.size() < 2) return true;
    const DenseMatrix zero = N_ * algebra::complement(e_), wanted = slipping_.transpose() * zero;
    const DenseMatrix left = wanted - zero * algebra::least_squares(zero, wanted);
    return left.norm() <= kParallel * slipping_.norm() * N_.norm();
  }

  /// The least value of (λ − Sλ)ᵀ(Wλ − x₀) + linearᵀλ + constant on the forces in balance and in the cones. Nothing if this is not convex or
  /// the program is not solved. Sets size_ to the magnitude of the terms.
  std::optional<double> least(const DenseMatrix& S, const Vector& linear, double constant, Monitor& monitor) {
    const Eigen::Index modes = e_.size();
    const DenseMatrix half = W_ - S.transpose() * W_, squared = N_ * N_.transpose();
    // The program is solved in units of force and energy in which it is of size 1.
    const double force = e_.norm() / N_.norm(), yield = half.norm(), energy = yield * force * force;
    // Forces in balance have Nᵀλ = e. If the program is convex on them, it becomes convex everywhere by adding a multiple of ‖Nᵀλ − e‖².
    const double weight = 10 / squared.norm();
    program::QuadraticProgram program;
    program.name = "friction";
    const DenseMatrix P = (half + half.transpose()) / yield + 2 * weight * squared;
    program.P = DenseMatrix(P.triangularView<Eigen::Lower>()).sparseView();
    program.q = (S.transpose() * x0_ - x0_ + linear) / (yield * force) - 2 * weight * (N_ * (e_ / force));
    program.r = constant / energy + weight * (e_ / force).squaredNorm();
    if (program::negative_curvature(program.P).size() > 0) return std::nullopt;
    program.A = rows();
    program.low = Vector::Zero(count_ + modes), program.high = Vector::Constant(count_ + modes, INFINITY);
    program.low.tail(modes) = program.high.tail(modes) = e_ / force;
    if (!program.q.allFinite() || !program.P.coeffs().allFinite()) return std::nullopt;
    const program::Result found = program::solve(program, program::InteriorPoint{}, monitor);
    if (found.status != program::Status::solved) return std::nullopt;
    size_ = energy * (found.x.dot(half * found.x) / yield + std::abs(found.x.dot(x0_)) / (yield * force)) + std::abs(constant);
    return energy * found.objective;
  }

  SparseRows rows() const {
    std::vector<Eigen::Triplet<double>> all = limits_;
    for (Eigen::Index r = 0; r < N_.rows(); ++r)
      for (Eigen::Index k = 0; k < N_.cols(); ++k)
        if (N_(r, k) != 0) all.emplace_back(count_ + static_cast<int>(k), static_cast<int>(r), N_(r, k));
    SparseRows out(count_ + N_.cols(), N_.rows());
    out.setFromTriplets(all.begin(), all.end());
    return out;
  }

  const Problem& problem_;
  const Vector root_;
  DenseMatrix W_;
  const Vector x0_;
  const DenseMatrix N_;
  const Vector e_;
  const Vector slip_;  ///< N v, unscaled
  const double work_;
  std::vector<char> pushes_;
  DenseMatrix slipping_;  ///< S: Sλ = μsp on the rows of friction
  std::vector<Eigen::Triplet<double>> limits_;
  int count_ = 0;
  double size_ = 0;
  bool treatable_;
};

}  // namespace

std::optional<FrictionalMotion> stopped_by_friction_alone(const Problem& problem) {
  Problem smooth = problem;
  std::erase_if(smooth.friction, [](const FrictionGroup& group) {
    for (int k = 0; k < group.points(); ++k)
      if (group.law->follows(k)) return true;
    return false;
  });
  if (problem.blocks.empty() || smooth.friction.size() == problem.friction.size()) return std::nullopt;
  problem::RigidMotions rigid = problem::rigid_motions(problem);
  problem::Solvability s = problem::solvability(rigid, smooth);
  if (s.verdict != problem::Solvability::Verdict::unsolvable) return std::nullopt;
  return FrictionalMotion{std::move(rigid), std::move(s.motion), s.work};
}

double friction_capacity(const Problem& problem, const FrictionalMotion& motion, const Vector& lambda) {
  const Vector slip = motion.rigid.N * motion.amounts;
  double sum = 0;
  for (const auto& [group, k, t, n] : problem.friction_points()) sum += group.bound(k, lambda) * slip.segment(t, group.components).norm();
  return sum;
}

bool friction_is_too_weak(const Problem& problem, const CondensedProblem& condensed, const FrictionalMotion& motion, Monitor& monitor) {
  return problem.rows() <= kMostBoundRows && FrictionPrograms(problem, condensed, motion).prove(monitor);
}

}  // namespace dotyk::solver
