#include "solver/core/settled_overlap.hpp"

#include "algebra/direct/cholesky.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::Vector;
using problem::Problem;

namespace {

/// Of all forces: where steps end, and what is enough. Friction comes at once when a row closes, so that there may be no balance.
constexpr double kBalanced = 1e-6, kNearlyBalanced = 1e-2;

/// A block is L ≈ h n^(1/d) wide, of n nodes h apart: pressure on it moves what it acts on L/h times as far as its row's own stiffness says.
double nodes_across(const problem::Block& block) {
  const double nodes = block.node.back() - block.node.front() + 1;
  const double dimension = std::ceil(block.size() / nodes);
  return std::pow(nodes, 1 / dimension);
}

/// Rigid bodies on the rows' springs: the forces at amounts α of their motions, and how they change with the overlap.
class Springs {
 public:
  explicit Springs(const Problem& problem)
      : problem_(problem), rigid_(problem::rigid_motions(problem)), N_(rigid_.noticed_N), k_(problem.row_stiffness()) {
    double softer = 1;
    for (const problem::Block& block : problem.blocks) softer = std::max(softer, nodes_across(block));
    k_ /= softer;
  }

  const Vector& load() const { return rigid_.noticed_e; }
  /// Beside all forces.
  double share(const Vector& unbalanced, const Vector& alpha) {
    const Vector gross = load().cwiseAbs() + SparseMatrix(N_.cwiseAbs()).transpose() * forces(overlap(alpha)).cwiseAbs();
    return unbalanced.norm() / gross.norm();
  }
  const SparseMatrix& N() const { return N_; }
  const Vector& stiffness() const { return k_; }
  Vector overlap(const Vector& alpha) const { return N_ * alpha - problem_.c; }
  Vector unbalanced(const Vector& alpha) { return load() - N_.transpose() * forces(overlap(alpha)); }

  /// Sets slope_, too.
  Vector forces(const Vector& overlap) {
    Vector lambda = k_.cwiseProduct(overlap);
    slope_ = k_;
    for (const problem::RowGroup& group : problem_.groups)
      for (int i = 0; i < group.count; ++i) {
        const int r = group.first + i;
        const problem::Projection p = group.law->project(i, lambda[r], k_[r]);
        lambda[r] = p.lambda, slope_[r] *= p.slope;
      }
    for (const problem::FrictionGroup& group : problem_.friction)
      for (int point = 0; point < group.points(); ++point)
        if (const int normal = group.normal[point]; normal >= 0 && slope_[normal] == 0)
          lambda.segment(group.row(point), group.components).setZero(), slope_.segment(group.row(point), group.components).setZero();
    return lambda;
  }
  /// At the last forces().
  const Vector& slope() const { return slope_; }

 private:
  const Problem& problem_;
  problem::RigidMotions rigid_;
  SparseMatrix N_;
  Vector k_, slope_;
};

}  // namespace

std::optional<Vector> settled_overlap(const Problem& problem) {
  constexpr int kSteps = 50, kHalvings = 30;
  constexpr double kFloor = 1e-6;  // of the stiffness of open rows, so that every step is definite
  if (!std::all_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.rigid && b.size() > 0; })) return std::nullopt;
  Springs springs(problem);
  const SparseMatrix& N = springs.N();
  const Vector& k = springs.stiffness();
  Vector alpha = Vector::Zero(N.cols());
  Vector left = springs.load() + N.transpose() * k.cwiseProduct(problem.c), slope = k;  // at first all rows hold
  const auto stiffness = [&] { return SparseMatrix(SparseMatrix(N.transpose() * SparseMatrix(slope.asDiagonal() * N)).triangularView<Eigen::Lower>()); };
  if (N.cols() == 0) return springs.overlap(alpha);
  std::vector<int> own(static_cast<std::size_t>(N.cols()));
  std::iota(own.begin(), own.end(), 0);
  algebra::Cholesky cholesky(stiffness(), own, {});
  double share = INFINITY;
  for (int step = 0; step < kSteps && share > kBalanced && cholesky.factor(stiffness()); ++step) {
    const Vector d = cholesky.solve(left);
    // A convex energy falls along d until its slope turns.
    double length = 1;
    int halvings = 0;
    for (; halvings < kHalvings && step > 0 && d.dot(springs.unbalanced(alpha + length * d)) < 0; ++halvings) length /= 2;
    alpha += length * d;
    left = springs.unbalanced(alpha);
    slope = springs.slope().cwiseMax(kFloor * k);
    share = springs.share(left, alpha);
    if (halvings == kHalvings) break;
  }
  return share <= kNearlyBalanced ? std::optional<Vector>(springs.overlap(alpha)) : std::nullopt;
}

}  // namespace dotyk::solver
