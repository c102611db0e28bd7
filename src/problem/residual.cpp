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

Residual residual(const Problem& problem, const State& state) {
  Residual result;
  const Vector internal = stiffness_times(problem, state.u);
  const Vector contact = problem.B.transpose() * state.lambda;
  Vector load(problem.unknowns());
  for (const Block& block : problem.blocks) load.segment(block.first, block.size()) = block.f;
  const double scale = internal.norm() + contact.norm() + load.norm();
  if (scale > 0) result.equilibrium = (internal + contact - load).norm() / scale;
  if (problem.rows() == 0) return result;

  const Vector jump = problem.B * state.u, x = jump - problem.c;
  const double moved = std::max(jump.lpNorm<Eigen::Infinity>(), state.u.lpNorm<Eigen::Infinity>());
  double work = 0, product = 0;
  for (const RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double length = std::max(moved, std::abs(problem.c[r]));
      if (length > 0) result.penetration = std::max(result.penetration, x[r] / length);
      product += std::abs(state.lambda[r] * x[r]);
      work += std::abs(state.lambda[r] * problem.c[r]);
    }
  }
  work += std::abs(0.5 * state.u.dot(internal)) + std::abs(state.u.dot(load));
  if (work > 0) result.complementarity = product / work;
  result.law = natural_residual(problem, x, state.lambda, problem.row_stiffness());
  return result;
}

}  // namespace dotyk::problem
