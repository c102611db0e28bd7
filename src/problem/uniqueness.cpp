#include "problem/uniqueness.hpp"

#include <Eigen/SparseCholesky>

#include "algebra/dense/dense.hpp"
#include "algebra/krylov/lanczos.hpp"
#include "algebra/dense/null_space.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// The noticed motions that no row holds both ways: modes × count.
SparseMatrix two_sided(const RigidMotions& rigid, const Problem& problem) {
  std::vector<char> holds(static_cast<std::size_t>(problem.rows()), 0);
  for (const RowGroup& group : problem.groups)
    for (int k = 0; k < group.count; ++k) holds[static_cast<std::size_t>(group.first + k)] = group.law->linear_stiffness(k).value_or(0) > 0;
  SparseMatrix held = rigid.noticed_N;
  held.prune([&](int row, int, double) { return holds[static_cast<std::size_t>(row)] != 0; });
  return rigid.noticed * algebra::range_and_null(held, kNotAtAll).unseen;
}

/// The most that laws other than unilateral ones can resist a motion with, or give it: j(w). Infinite where one has no limit.
double resistance(const RigidMotions& rigid, const Problem& problem, const Vector& w) {
  const Vector jump = rigid.N * w;
  double sum = 0;
  for (const RowGroup& group : problem.groups)
    for (int k = 0; k < group.count && !group.law->unilateral(); ++k) {
      const Interval bounds = group.law->multipliers(k);
      const double moved = std::abs(jump[group.first + k]);
      if (moved > kNotAtAll) sum += moved * std::max(std::abs(bounds.low), std::abs(bounds.high));
    }
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) sum += group.law->bound(k, 0) * jump.segment(group.row(k), group.components).norm();
  return sum;
}

/// Are the rows of B independent? Each of unit length, a pivot of BBᵀ is the square of a row's distance from the span of others.
bool full_rank(const SparseRows& B) {
  if (B.rows() == 0) return true;
  Vector inverse(B.rows());
  for (int r = 0; r < B.rows(); ++r) {
    const double length = B.row(r).norm();
    if (!(length > 0)) return false;
    inverse[r] = 1 / length;
  }
  const SparseRows unit = inverse.asDiagonal() * B;
  const SparseMatrix gram = unit * SparseRows(unit.transpose());
  const Eigen::SimplicialLDLT<SparseMatrix> ldlt(gram);
  return ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 1e-12;
}

/// Would the problem without friction keep its motions bounded?
bool coercive_without_friction(const Problem& problem) {
  Problem bare;
  bare.blocks = problem.blocks, bare.sliced_load = problem.sliced_load;
  bare.c = problem.c;
  bare.groups = problem.groups;
  for (const FrictionGroup& group : problem.friction)  // free rows
    bare.groups.push_back({group.name, elastic(std::vector<double>(static_cast<std::size_t>(group.points() * group.components), 0.0)), group.first,
                           group.points() * group.components});
  Vector kept = Vector::Ones(problem.rows());
  for (const FrictionGroup& group : problem.friction) kept.segment(group.first, group.points() * group.components).setZero();
  bare.B = kept.asDiagonal() * problem.B;
  const RigidMotions rigid = rigid_motions(bare);
  const Solvability s = solvability(rigid, bare);
  return s.verdict == Solvability::Verdict::unique && !s.limit;
}

}  // namespace

bool has_coulomb(const Problem& problem) {
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      if (group.law->follows(k)) return true;
  return false;
}

Uniqueness uniqueness(const RigidMotions& rigid, const Problem& problem) {
  Uniqueness u;
  u.coulomb = has_coulomb(problem);
  const SparseMatrix free = two_sided(rigid, problem);
  u.held = free.cols() + rigid.unnoticed.cols() == 0;
  if (u.coulomb) {
    u.exists = full_rank(problem.B) && (u.held || coercive_without_friction(problem));
    return u;
  }
  if (free.cols() == 1) {
    u.motion = free.col(0);
    u.motion /= u.motion.lpNorm<Eigen::Infinity>();
    const double resists = resistance(rigid, problem, u.motion), work = std::abs(rigid.e.dot(u.motion));
    u.unique = work > (1 + 1e-9) * resists;
  } else {
    u.unique = free.cols() == 0;
  }
  if (u.unique) u.motion.resize(0);
  return u;
}

std::optional<double> uniqueness_factor(const Problem& problem, const CondensedProblem& condensed) {
  std::vector<int> normals, rows;
  std::vector<double> weights, scales;  // s^½ μ of points, s^-½ of rows
  const DenseMatrix& W = condensed.W();
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      if (const double mu = group.law->bound_slope(k); mu > 0) {
        const double root = std::sqrt(W.diagonal().segment(group.row(k), group.components).mean());
        normals.push_back(group.normal[k]), weights.push_back(root * mu);
        for (int i = 0; i < group.components; ++i) rows.push_back(group.row(k) + i), scales.push_back(1 / root);
      }
  if (normals.empty()) return std::numeric_limits<double>::infinity();
  if (condensed.kernel_size() > 0) return std::nullopt;
  DenseMatrix L = W;
  if (!(W.diagonal().minCoeff() > 0)) return std::nullopt;
  if (!algebra::cholesky(L) || !(L.diagonal().minCoeff() > 1e-7 * std::sqrt(W.diagonal().maxCoeff()))) return std::nullopt;
  DenseMatrix columns = DenseMatrix::Zero(W.rows(), static_cast<Eigen::Index>(normals.size()));  // s^½ μ L⁻¹ P_nᵀ
  for (std::size_t i = 0; i < normals.size(); ++i) columns(normals[i], static_cast<Eigen::Index>(i)) = weights[i];
  algebra::solve_lower(L, columns);
  DenseMatrix tangential = W(rows, rows);
  const Eigen::Map<const Vector> s(scales.data(), static_cast<Eigen::Index>(scales.size()));
  tangential = s.asDiagonal() * tangential * s.asDiagonal();
  return 2 / std::sqrt(algebra::proved_largest_eigenvalue(algebra::gram(columns)) * algebra::proved_largest_eigenvalue(tangential));
}

}  // namespace dotyk::problem
