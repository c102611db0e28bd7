#include "solver/core/settle.hpp"

#include "algebra/dense/null_space.hpp"
#include "problem/uniqueness.hpp"
#include "program/active_set.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// What is known of the stress where the displacement is not unique.
const char* stress(const problem::Problem& problem) {
  return problem::has_coulomb(problem) ? "; with the stress of this solution" : "; unique stress";
}

std::string end(double amount) { return std::isfinite(amount) ? text(amount) : amount < 0 ? "-infinity" : "infinity"; }

/// The amounts α of free motions of least ½αᵀGα − wantedᵀα within their limits, from 0 on. In units in which G has the diagonal 1.
Vector least_amounts(const problem::FreeMotions& free, const DenseMatrix& G, const Vector& wanted) {
  const Eigen::Index k = G.cols(), m = free.limits.rows();
  const Vector unit = G.diagonal().unaryExpr([](double g) { return g > 0 ? 1 / std::sqrt(g) : 1.0; });
  const DenseMatrix metric = unit.asDiagonal() * G * unit.asDiagonal();
  program::QuadraticProgram nearest{"nearest", DenseMatrix(metric.triangularView<Eigen::Lower>()).sparseView(), -unit.cwiseProduct(wanted), 0,
                                    m > 0 ? SparseRows(free.limits * unit.asDiagonal()) : SparseRows(0, k), Vector::Constant(m, -INFINITY), free.slack};
  program::ActiveSet settings;
  settings.start = program::ActiveSet::Start::cold;
  settings.point = Vector::Zero(k);
  Monitor quiet;
  const program::Result found = program::solve(nearest, settings, quiet);
  return found.status == program::Status::solved ? unit.cwiseProduct(found.x) : Vector(Vector::Zero(k));
}

/// The motions, how far they go, and of all states that differ by them the one nearest to `before`; where unknowns are hidden the state stays as it is.
void take_nearest(const problem::Problem& problem, const problem::FreeMotions& free, const problem::Displacement& before, Result& result) {
  const int count = free.count;
  Eigen::MatrixXd D = problem::displacement(problem, free.motions);
  if (free.unnoticed.cols() > 0) {
    const auto unnoticed = algebra::orthonormal(problem::displacement(problem, free.unnoticed));
    for (int k = 0; k < count; ++k) D.col(k) = problem::least(unnoticed, D.col(k));
  }
  const bool hides = problem.hides(), at_rest = before.size() == 0 || before.here().isZero(0);
  Vector amounts = Vector::Zero(count);
  if (!hides) {
    Vector& u = result.state.u.change();
    const Vector wanted = at_rest ? Vector(-u) : Vector(before.here() - u);
    amounts = least_amounts(free, D.transpose() * D, D.transpose() * wanted);
    u += D * amounts;
  }
  int widest = 0;
  problem::Interval range{0, 0};  // of the motion that may go furthest, as a displacement
  for (int k = 0; k < count; ++k) {
    const double size = D.col(k).lpNorm<Eigen::Infinity>();
    const problem::Interval own = free.range(k, amounts);
    if ((own.high - own.low) * size > range.high - range.low) widest = k, range = {own.low * size, own.high * size};
  }
  if (range.high - range.low <= 1e-9 * result.state.u.here().lpNorm<Eigen::Infinity>()) return;  // they have nowhere to go
  const std::string which = describe(problem::body_motions(problem), Vector(free.motions.col(widest)));
  result.reason += text(stress(problem), ", displacement up to ", count == 1 ? which : text(count, " motions, one of them ", which),
                        ", by displacements from ", end(range.low), " to ", end(range.high),
                        " at the most: the contacts that hold leave ", count == 1 ? "it" : "them", " free until the next node closes or sticks, so that the mesh decides how "
                        "far; this is ", hides ? "one of them" : at_rest ? "the least" : "the nearest to the step before");
}

}  // namespace

problem::FreeMotions settle(const problem::Problem& problem, const problem::Displacement& before, Result& result) {
  problem::FreeMotions free;
  if (!result.converged || problem.rows() == 0) return free;
  try {
    free = problem::free_motions(problem, result.state, kOnBound);
  } catch (const Interrupted&) {
    result.reason += "; interrupted before it was known which motions the contacts that hold leave free";
    return free;
  }
  // Without loads the rounding of motions added up may be all the strain there is.
  if (free.count == 1 || (free.count > 0 && free.count <= problem::kMostModes && problem.loaded()))
    take_nearest(problem, free, before, result);
  else if (free.count > 0)
    result.reason += text(stress(problem), ", displacement up to ", free.count, " motions that the contacts that hold leave free",
                          free.motions.cols() > 0 ? ", one of them " + describe(problem::body_motions(problem), Vector(free.motions.col(0))) : "");
  return free;
}

double settle_on_springs(const problem::Problem& problem, double most, problem::State& state) {
  Vector springs = Vector::Zero(problem.rows());
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (const auto own = law.linear_stiffness(k); own && std::isfinite(*own)) springs[r] = *own;
  if (springs.isZero(0) || problem.hides()) return 0;
  const problem::FreeMotions free = problem::free_motions(problem, state, kOnBound, false);
  if (free.motions.cols() == 0) return 0;
  const problem::RigidMotions rigid = problem::rigid_motions(problem);
  const SparseMatrix jump = SparseMatrix(rigid.N * free.motions).pruned(1, problem::kNotAtAll), moved = problem::displacement(problem, free.motions);
  const DenseMatrix held = jump.transpose() * SparseMatrix(springs.asDiagonal() * jump);
  const Vector yields = held.diagonal().unaryExpr([](double k) { return k > 0 ? 1 / k : 0.0; });
  const Vector left = free.motions.transpose() * (rigid.e - rigid.N.transpose() * state.lambda);
  const Vector amounts = least_amounts(free, held, left);
  const Vector gross = SparseMatrix(free.motions.cwiseAbs()).transpose() * rigid.e.cwiseAbs() + SparseMatrix(jump.cwiseAbs()).transpose() * state.lambda.cwiseAbs();
  Vector by_rounding = gross.cwiseProduct(yields);
  for (Eigen::Index k = 0; k < moved.cols(); ++k) by_rounding[k] *= Vector(moved.col(k)).lpNorm<Eigen::Infinity>();
  const Vector u = state.u.here() + moved * amounts;
  const double lost = std::numeric_limits<double>::epsilon() * by_rounding.maxCoeff() / u.lpNorm<Eigen::Infinity>();
  if (!(lost <= most)) return lost;
  state.u = u;
  state.lambda += springs.cwiseProduct(jump * amounts);
  return lost;
}

}  // namespace dotyk::solver
