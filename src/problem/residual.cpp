#include "problem/residual.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

#include "base/text.hpp"

namespace dotyk::problem {

using algebra::Vector;

double distance_from_laws(const Problem& problem, const Vector& x, const Vector& lambda, const Vector& rho) {
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
  return std::sqrt(sum);
}

double natural_residual(const Problem& problem, const Vector& x, const Vector& lambda, const Vector& rho) {
  const double scale = lambda.norm();
  return distance_from_laws(problem, x, lambda, rho) / (scale > 0 ? scale : 1);
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

/// Ku, Bᵀλ and f of all blocks.
struct Forces {
  Vector internal, contact, load;
  double size() const { return internal.stableNorm() + contact.stableNorm() + load.stableNorm(); }
};

Forces forces(const Problem& problem, const State& state) {
  Forces all{stiffness_times(problem, state.u), problem.B.transpose() * state.lambda, Vector(problem.unknowns())};
  for (const Block& block : problem.blocks) all.load.segment(block.first, block.size()) = block.f;
  return all;
}

/// |K||w|.
Vector gross_forces(const Block& block, const Vector& w) {
  Vector sum = Vector::Zero(w.size());
  for (int j = 0; j < block.K.outerSize(); ++j)
    for (algebra::SparseMatrix::InnerIterator it(block.K, j); it; ++it) {
      sum[it.row()] += std::abs(it.value() * w[j]);
      if (it.row() != j) sum[j] += std::abs(it.value() * w[it.row()]);
    }
  return sum;
}

/// ‖|K||w|‖, w the part of u in the block's kernel.
double moved_forces(const Block& block, const Vector& u) {
  const algebra::DenseMatrix& R = block.kernel;
  return gross_forces(block, R * R.colPivHouseholderQr().solve(u)).stableNorm();
}

/// Where nothing loads the bodies, the least that counts as a force, and as work: what half of the digits of K|u| are. Bodies that
/// get out of an obstacle's way end free of forces, and rounding of K times their motion is all that is left of those.
struct Least {
  double force = 0, work = 0;
};

Least least(const Problem& problem, const State& state, double load) {
  if (load > 0) return {};
  const double half = std::sqrt(std::numeric_limits<double>::epsilon());
  Least result;
  for (const Block& block : problem.blocks) {
    const auto u = state.u.segment(block.first, block.size());
    const Vector gross = gross_forces(block, u);
    result.force = std::hypot(result.force, half * gross.stableNorm());
    result.work += half * gross.dot(u.cwiseAbs());
  }
  return result;
}

/// Greatest resultant of the forces on the block that is not balanced, relative to all of them (`gross`) at the longest lever.
double unbalanced(const Block& block, const Vector& force, double gross) {
  double most = 0;
  for (const auto& mode : block.kernel.colwise())
    most = std::max(most, std::abs(mode.dot(force)) / (mode.lpNorm<Eigen::Infinity>() * gross));
  return gross > 0 ? most : 0;
}

}  // namespace

MotionResidual motion_residual(const Problem& problem, const State& state) {
  constexpr double kRoundings = 4;  // of u itself and of the sums in Ku
  const Forces all = forces(problem, state);
  const Vector gross = algebra::SparseRows(problem.B.cwiseAbs()).transpose() * state.lambda.cwiseAbs() + all.load.cwiseAbs();
  const Least least = problem::least(problem, state, all.load.stableNorm());
  MotionResidual result;
  double greatest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto own = [&](const Vector& v) { return v.segment(block.first, block.size()); };
    const Vector force = own(all.contact) - own(all.load);
    const double left = (own(all.internal) + force).stableNorm();
    double granted = 0;
    if (block.kernel.cols() > 0) {
      granted = kRoundings * std::numeric_limits<double>::epsilon() * moved_forces(block, own(state.u));
      result.resultants = std::max(result.resultants, unbalanced(block, force, std::max(own(gross).sum(), least.force)));
    }
    if (std::min(left, granted) > greatest) greatest = std::min(left, granted), result.most = static_cast<int>(b);
    result.beyond = std::hypot(result.beyond, std::max(0.0, left - granted));
  }
  if (const double scale = std::max(all.size(), least.force); scale > 0) result.beyond /= scale;
  return result;
}

namespace {

/// The greatest distance of a row, or of a friction point, from its law's graph; see Residual.
double greatest_distance(const Problem& problem, const Vector& lambda, const Vector& x, const Scales& scales) {
  const auto rho = [&](double gap) { return scales.force / std::max(scales.length, gap); };
  double most = 0;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double k = rho(std::abs(problem.c[r]));
      most = std::max(most, std::abs(lambda[r] - group.law->project(r - group.first, lambda[r] + k * x[r], k).lambda));
    }
  for (const FrictionGroup& group : problem.friction)
    for (int i = 0; i < group.points(); ++i) {
      const int r = group.row(i), n = group.components;
      const auto own = lambda.segment(r, n);
      const Vector y = own + rho(problem.c.segment(r, n).lpNorm<Eigen::Infinity>()) * x.segment(r, n);
      most = std::max(most, (own - project_disc(y, group.bound(i, lambda)).value).norm());
    }
  return most / scales.force;
}

double greatest(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }

/// What the multipliers would move a row of the greatest stiffness by, times a millionth. Where loads meet their reactions at the
/// contact itself nothing moves but by rounding: this is the least scale.
double yielding(const Problem& problem, const State& state) {
  const double stiffest = problem.rows() > 0 ? problem.row_stiffness().maxCoeff() : 0;
  return stiffest > 0 ? 1e-6 * greatest(state.lambda) / stiffest : 0;
}

}  // namespace

Scales scales(const Problem& problem, const State& state) {
  Scales result;
  const Forces all = forces(problem, state);
  const double least = problem::least(problem, state, all.load.stableNorm()).force;
  if (const double force = std::max({greatest(state.lambda), greatest(all.load), least}); force > 0) result.force = force;
  const double length = std::max({greatest(problem.B * state.u), greatest(state.u), yielding(problem, state)});
  if (length > 0) result.length = length;
  return result;
}

Residual residual(const Problem& problem, const State& state) {
  Residual result;
  const Forces all = forces(problem, state);
  const Least least = problem::least(problem, state, all.load.stableNorm());
  const double scale = std::max(all.size(), least.force);
  if (scale > 0) result.equilibrium = (all.internal + all.contact - all.load).stableNorm() / scale;
  if (problem.rows() == 0) return result;

  const Vector x = problem.B * state.u - problem.c;
  const Scales scales = problem::scales(problem, state);
  double work = state.lambda.lpNorm<1>() * yielding(problem, state), product = 0;
  for (const RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      result.penetration = std::max(result.penetration, x[r] / std::max(scales.length, std::abs(problem.c[r])));
      product += std::abs(state.lambda[r] * x[r]);
      work += std::abs(state.lambda[r] * problem.c[r]);
    }
  }
  work += least.work + std::abs(0.5 * state.u.dot(all.internal)) + std::abs(state.u.dot(all.load));
  if (work > 0) result.complementarity = product / work;
  result.friction = friction_violation(problem, state);
  result.law = greatest_distance(problem, state.lambda, x, scales);
  return result;
}

double rounding_of_equilibrium(const Problem& problem, const State& state) {
  double gross = 0;
  for (const Block& block : problem.blocks) gross = std::hypot(gross, gross_forces(block, state.u.segment(block.first, block.size())).stableNorm());
  const double size = forces(problem, state).size();
  return size > 0 ? std::numeric_limits<double>::epsilon() * gross / size : 0;
}

std::string describe(const Residual& r) {
  return text(std::setprecision(3), "equilibrium ", r.equilibrium, ", penetration ", r.penetration, ", complementarity ", r.complementarity,
              ", friction ", r.friction, ", law ", r.law);
}

}  // namespace dotyk::problem
