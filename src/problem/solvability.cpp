#include "problem/solvability.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "algebra/bounded_least_squares.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Work below this part of the load's size counts as none: rounding of Rᵀf and of the modes.
constexpr double kRounding = 1e-10;
/// A load this close (as an angle) to the edge of what can be carried is a limit case.
constexpr double kLimit = 1e-6;

Vector unit(const Vector& v) { return v / v.lpNorm<Eigen::Infinity>(); }

/// Motions that no row notices: the null space of N.
DenseMatrix unnoticed(const RigidMotions& rigid) {
  const int modes = rigid.count();
  DenseMatrix square = DenseMatrix::Zero(std::max<Eigen::Index>(rigid.N.rows(), modes), modes);
  square.topRows(rigid.N.rows()) = rigid.N;
  const Eigen::JacobiSVD<DenseMatrix> svd(square, Eigen::ComputeFullV);
  int rank = 0;
  // Modes have greatest displacement 1: 1e-9 of that is "not at all".
  while (rank < modes && svd.singularValues()[rank] > 1e-9 * std::max(1.0, svd.singularValues()[0])) ++rank;
  return svd.matrixV().rightCols(modes - rank);
}

/// What of the load e no admissible multipliers balance: the admissible motion it drives most.
Vector unbalanced(const RigidMotions& rigid, const Problem& problem, const Vector& e) {
  Vector low(problem.rows()), high(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const Interval bounds = group.law->multipliers(r - group.first);
      low[r] = bounds.low;
      high[r] = bounds.high;
    }
  return algebra::bounded_least_squares(rigid.N.transpose(), e, low, high).residual;
}

/// The middle of what unilateral rows can carry, unit length; zero where there are none.
Vector middle_load(const RigidMotions& rigid, const Problem& problem) {
  Vector sum = Vector::Zero(rigid.count());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (group.law->unilateral()) sum += rigid.N.row(r).transpose();
  return sum.norm() > 0 ? Vector(sum / sum.norm()) : sum;
}

}  // namespace

RigidMotions rigid_motions(const Problem& problem) {
  RigidMotions rigid;
  int modes = 0;
  for (const Block& block : problem.blocks) modes += static_cast<int>(block.kernel.cols());
  rigid.N = DenseMatrix::Zero(problem.rows(), modes);
  rigid.e = Vector::Zero(modes);
  int k = 0;
  for (const Block& block : problem.blocks) {
    const int count = static_cast<int>(block.kernel.cols());
    if (count == 0) continue;
    rigid.N.middleCols(k, count) = problem.rows_of(block) * block.kernel;
    rigid.e.segment(k, count) = block.kernel.transpose() * block.f;
    for (const std::string& name : block.kernel_names) rigid.names.push_back("'" + block.name + "': " + name);
    k += count;
  }
  return rigid;
}

std::string describe(const RigidMotions& rigid, const Vector& motion) {
  std::string out;
  const double largest = motion.lpNorm<Eigen::Infinity>();
  int terms = 0;
  for (int k = 0; k < motion.size(); ++k)
    if (std::abs(motion[k]) > 1e-6 * largest) ++terms;
  for (int k = 0; k < motion.size(); ++k) {
    if (!(std::abs(motion[k]) > 1e-6 * largest)) continue;
    out += (out.empty() ? "" : ", ") + rigid.names[k];
    if (terms > 1) out += text(" by ", std::round(1e4 * motion[k] / largest) / 1e4);
    else if (motion[k] < 0) out += " (backwards)";
  }
  return out;
}

Solvability solvability(const RigidMotions& rigid, const Problem& problem) {
  Solvability s;
  s.two_sided = DenseMatrix(rigid.count(), 0);
  if (rigid.count() == 0) return s;
  s.two_sided = unnoticed(rigid);
  const double load = rigid.e.norm();
  const Vector residual = load > 0 ? unbalanced(rigid, problem, rigid.e) : Vector::Zero(rigid.count());
  if (residual.norm() > kRounding * load) {
    s.verdict = Solvability::Verdict::unsolvable;
    s.motion = unit(residual);
    s.work = rigid.e.dot(s.motion);
    return s;
  }
  // Towards the edge: take a little of the middle load away and see whether the rest still balances.
  const Vector middle = middle_load(rigid, problem);
  const Vector turned = rigid.e - kLimit * (load > 0 ? load : 1) * middle;
  const Vector edge = middle.norm() > 0 ? unbalanced(rigid, problem, turned) : Vector::Zero(rigid.count());
  s.limit = edge.norm() > 1e-3 * kLimit * (load > 0 ? load : 1);
  if (s.two_sided.cols() > 0) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = unit(s.two_sided.col(0));
  } else if (s.limit) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = unit(edge);
    s.work = rigid.e.dot(s.motion);
  }
  return s;
}

}  // namespace dotyk::problem
