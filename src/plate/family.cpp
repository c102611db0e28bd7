#include "plate/family.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::plate {

using algebra::Vector;

namespace {

/// Of x, at this λ: both ends the same but where λ is at a limit of the law, where φ* ends.
problem::Interval allowed(const problem::Law& law, int row, double lambda, double x, double noise) {
  const problem::Interval bounds = law.multipliers(row);
  problem::Interval out{x, x};
  if (lambda <= bounds.low + noise) out.low = -INFINITY, out.high = problem::following(law, row).low;
  if (lambda >= bounds.high - noise) out.high = INFINITY, out.low = lambda <= bounds.low + noise ? -INFINITY : problem::following(law, row).high;
  return out;
}

}  // namespace

Vector of_freedoms(const Model& model, const Vector& amounts) {
  const problem::Block& block = model.problem.blocks.front();
  Vector moved = block.kernel * amounts;
  Vector all = Vector::Zero(model.space.count());
  for (int i = 0; i < all.size(); ++i)
    if (model.unknown[i] >= 0) all[i] = moved[model.unknown[i]];
  return all / all.lpNorm<Eigen::Infinity>();
}

Vector by_motion(const algebra::SparseRows& B, const Vector& moved) {
  Vector by = B * moved;
  const double greatest = moved.size() ? moved.lpNorm<Eigen::Infinity>() : 0;
  for (int r = 0; r < B.rows(); ++r) {
    double sum = 0;
    for (algebra::SparseRows::InnerIterator it(B, r); it; ++it) sum += std::abs(it.value());
    if (std::abs(by[r]) <= 1e-9 * sum * greatest) by[r] = 0;
  }
  return by;
}

Family family(const Model& model, const problem::State& state, const Vector& motion) {
  const problem::Problem& problem = model.problem;
  const Vector moved = model.unknowns(motion);
  const Vector x = problem.B * state.u - problem.c, by = by_motion(problem.B, moved);
  const double noise = 1e-9 * std::max(state.lambda.size() ? state.lambda.lpNorm<Eigen::Infinity>() : 0.0, problem.blocks.front().f.lpNorm<Eigen::Infinity>());
  Family out{motion, -INFINITY, INFINITY};
  for (const problem::RowGroup& group : problem.groups)
    for (int k = 0; k < group.count; ++k) {
      const int r = group.first + k;
      if (by[r] == 0) continue;
      const problem::Interval at = allowed(*group.law, k, state.lambda[r], x[r], noise);
      double a = (at.low - x[r]) / by[r], b = (at.high - x[r]) / by[r];
      if (a > b) std::swap(a, b);
      out.from = std::max(out.from, a);
      out.to = std::min(out.to, b);
    }
  if (out.from > out.to) out.from = out.to = 0;
  const double rounding = 1e-12 * std::max(state.u.lpNorm<Eigen::Infinity>(), model.space.unit * 1e-3);
  for (double* end : {&out.from, &out.to})
    if (std::abs(*end) < rounding) *end = 0;
  return out;
}

}  // namespace dotyk::plate
