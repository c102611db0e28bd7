#include "problem/residual.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::problem {

using algebra::Vector;

double natural_residual(const Problem& problem, const Vector& x, const Vector& lambda,
                        const Vector& rho) {
  double sum = 0;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double y = lambda[r] + rho[r] * x[r];
      const double d = lambda[r] - group.law->project(r - group.first, y, rho[r]).lambda;
      sum += d * d;
    }
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int r = group.row(k);
      const auto own = lambda.segment(r, group.components);
      const Vector y = own + rho[group.scale_row(k)] * x.segment(r, group.components);
      const double bound = group.bound(k, lambda);
      sum += (own - project_disc(y, bound).value).squaredNorm();
    }
  const double scale = lambda.norm();
  return std::sqrt(sum) / (scale > 0 ? scale : 1);
}

double energy(const Problem& problem, const State& state) {
  const Vector force = stiffness_times(problem, state.u);
  double e = 0;
  for (const Block& block : problem.blocks) {
    const auto u = state.u.segment(block.first, block.size());
    e += block.offset + 0.5 * u.dot(force.segment(block.first, block.size())) - u.dot(block.f);
  }
  const Vector x = problem.B * state.u - problem.c;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      e += group.law->energy(r - group.first, x[r]);
  return e;
}

double friction_energy(const Problem& problem, const State& state) {
  const Vector x = problem.B * state.u - problem.c;
  double e = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      e += group.bound(k, state.lambda) * x.segment(group.row(k), group.components).norm();
  return e;
}

namespace {

/// Greatest excess of a friction force over its bound, relative to the greatest bound.
double friction_violation(const Problem& problem, const State& state) {
  double excess = 0, largest = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const double bound = group.bound(k, state.lambda);
      excess = std::max(excess, state.lambda.segment(group.row(k), group.components).norm() - bound);
      largest = std::max(largest, bound);
    }
  return largest > 0 ? excess / largest : excess;
}

}  // namespace

Residual residual(const Problem& problem, const State& state) {
  Residual result;
  const Vector internal = stiffness_times(problem, state.u);
  const Vector contact = problem.B.transpose() * state.lambda;
  Vector load(problem.unknowns());
  for (const Block& block : problem.blocks) load.segment(block.first, block.size()) = block.f;
  const double scale = internal.stableNorm() + contact.stableNorm() + load.stableNorm();
  if (scale > 0) result.equilibrium = (internal + contact - load).stableNorm() / scale;
  if (problem.rows() == 0) return result;

  const Vector jump = problem.B * state.u, x = jump - problem.c;
  const double moved = std::max(jump.lpNorm<Eigen::Infinity>(), state.u.lpNorm<Eigen::Infinity>());
  // Where loads meet their reactions at the contact itself nothing moves but by rounding: a millionth
  // of what the multipliers would move a row of the greatest stiffness by is the least scale.
  const Vector stiffness = problem.row_stiffness();
  const double yielding =
      stiffness.maxCoeff() > 0 ? 1e-6 * state.lambda.lpNorm<Eigen::Infinity>() / stiffness.maxCoeff() : 0;
  double work = state.lambda.lpNorm<1>() * yielding, product = 0;
  for (const RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double length = std::max({moved, std::abs(problem.c[r]), yielding});
      if (length > 0) result.penetration = std::max(result.penetration, x[r] / length);
      product += std::abs(state.lambda[r] * x[r]);
      work += std::abs(state.lambda[r] * problem.c[r]);
    }
  }
  work += std::abs(0.5 * state.u.dot(internal)) + std::abs(state.u.dot(load));
  if (work > 0) result.complementarity = product / work;
  result.friction = friction_violation(problem, state);
  result.law = natural_residual(problem, x, state.lambda, stiffness);
  return result;
}

}  // namespace dotyk::problem
