#include "scene/after_solve.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "algebra/null_space.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/free_motions.hpp"
#include "problem/residual.hpp"
#include "problem/uniqueness.hpp"
#include "program/active_set.hpp"
#include "solver/verdict.hpp"

namespace dotyk::scene {

using algebra::Vector;

namespace {

/// Multipliers within this part of the greatest are none, or are on their bound.
constexpr double kOnBound = 1e-8;
/// Smaller ones are rounding.
constexpr double kRounding = 1e-12;
/// Half the width of contact, in cells, that does not tell a rotation from none.
constexpr double kNarrow = 1.5;

/// What is known of the stress where the displacement is not unique.
const char* stress(const problem::Problem& problem) {
  return problem::has_coulomb(problem) ? "; with the stress of this solution" : "; unique stress";
}

std::string end(double amount) { return std::isfinite(amount) ? text(amount) : amount < 0 ? "-infinity" : "infinity"; }

/// Rows whose multiplier is rounding bear nothing, nor do those where it is as good as none and which have parted.
void open_without_force(const problem::Problem& problem, solver::Result& result) {
  if (result.active_sets.empty()) return;
  const Vector& lambda = result.state.lambda;
  const Vector x = problem.B * result.state.u - problem.c;
  const Vector none = problem::small_forces(problem, lambda, kOnBound);
  const std::vector<problem::Scales> scales = problem::scales(problem, result.state);
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      const problem::Scales& scale = scales[static_cast<std::size_t>(r)];
      if (lambda[r] <= kRounding * scale.force || (lambda[r] <= none[r] && x[r] < -kOnBound * scale.length)) result.active_sets.back()[r] = 0;
    }
}

/// The amounts of free motions nearest to `wanted` in the metric G = DᵀD of their displacements: within their limits, from 0 on.
Vector nearest_amounts(const problem::FreeMotions& free, const Eigen::MatrixXd& G, const Vector& wanted) {
  const Eigen::Index k = G.cols(), m = free.limits.rows();
  program::QuadraticProgram nearest{"nearest", Eigen::MatrixXd(G.triangularView<Eigen::Lower>()).sparseView(), -wanted, 0, free.limits,
                                    Vector::Constant(m, -INFINITY), free.slack};
  program::ActiveSet settings;
  settings.start = program::ActiveSet::Start::cold;
  settings.point = Vector::Zero(k);
  Monitor quiet;
  const program::Result found = program::solve(nearest, settings, quiet);
  return found.status == program::Status::solved ? found.x : Vector::Zero(k);
}

/// The motions, how far they go, and of all states that differ by them the one nearest to `before`.
void take_nearest(const problem::Problem& problem, const problem::FreeMotions& free, const Vector& before, solver::Result& result) {
  const int count = free.count;
  Eigen::MatrixXd D = problem::displacement(problem, free.motions);
  if (free.unnoticed.cols() > 0) {
    const auto unnoticed = algebra::orthonormal(problem::displacement(problem, free.unnoticed));
    for (int k = 0; k < count; ++k) D.col(k) = problem::least(unnoticed, D.col(k));
  }
  const Vector amounts = nearest_amounts(free, D.transpose() * D, D.transpose() * (before - result.state.u));
  result.state.u += D * amounts;
  int widest = 0;
  problem::Interval range{0, 0};  // of the motion that may go furthest, as a displacement
  for (int k = 0; k < count; ++k) {
    const double size = D.col(k).lpNorm<Eigen::Infinity>();
    const problem::Interval own = free.range(k, amounts);
    if ((own.high - own.low) * size > range.high - range.low) widest = k, range = {own.low * size, own.high * size};
  }
  if (range.high - range.low <= 1e-9 * result.state.u.lpNorm<Eigen::Infinity>()) return;  // they have nowhere to go
  const std::string which = describe(problem::body_motions(problem), Vector(free.motions.col(widest)));
  result.reason += text(stress(problem), ", displacement up to ", count == 1 ? which : text(count, " motions, one of them ", which),
                        ", by displacements from ", end(range.low), " to ", end(range.high),
                        " at the most: the contacts that hold leave ", count == 1 ? "it" : "them", " free until the next node closes or sticks, so that the mesh decides how "
                        "far; this is the ", before.isZero(0) ? "least" : "nearest to the step before");
}

/// The width of the widest cell of contact that presses.
double widest_cell(const Scene& scene, const Model& model, const Vector& lambda) {
  double widest = 0;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    for (std::size_t k = 0; k < model.contact_row[c].size(); ++k)
      if (const int r = model.contact_row[c][k]; r >= 0 && lambda[r] > kOnBound * lambda.lpNorm<Eigen::Infinity>())
        widest = std::max(widest, std::pow(scene.contacts[c]->rows[k].weight, 1.0 / (scene.dimension() - 1)));
  return widest;
}

/// Half of the longest side of the box about a body.
double half_extent(const Body& body) {
  double longest = 0;
  for (int i = 0; i < body.dimension(); ++i) {
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < body.mesh->node_count(); ++k) low = std::min(low, body.mesh->point(k)[i]), high = std::max(high, body.mesh->point(k)[i]);
    longest = std::max(longest, high - low);
  }
  return longest / 2;
}

/// A rotation that contact hardly wider than its cells resists.
std::string resisted_by_cells(const Scene& scene, const Model& model, const problem::Problem& problem, const problem::FreeMotions& free,
                              const Vector& lambda) {
  if (free.weakest.size() == 0) return "";
  const auto motions = problem::body_motions(problem);
  Eigen::Index mode;
  free.weakest.cwiseAbs().maxCoeff(&mode);
  if (motions.size() != static_cast<std::size_t>(free.weakest.size()) || motions[mode].motion.kind != Motion::Kind::rotation) return "";
  for (const auto& body : scene.bodies)
    if (body->name == motions[mode].body && free.grip * half_extent(*body) <= kNarrow * widest_cell(scene, model, lambda))
      return text("; ", motions[mode].text(), " is resisted only by terms of the order of the mesh (contact is hardly wider than its cells): how far it goes "
                  "is the mesh's");
  return "";
}

}  // namespace

void settle(const Scene& scene, const Model& model, const problem::Problem& problem, const Vector& before, solver::Result& result) {
  if (!result.converged || problem.rows() == 0) return;
  problem::FreeMotions free;
  try {
    free = problem::free_motions(problem, result.state, kOnBound);
  } catch (const Interrupted&) {
    result.reason += "; interrupted before it was known which motions the contacts that hold leave free";
    open_without_force(problem, result);
    return;
  }
  // Without loads the rounding of motions added up may be all the strain there is.
  if (free.count == 1 || (free.count > 0 && free.count <= problem::kMostModes && solver::loaded(problem)))
    take_nearest(problem, free, before, result);
  else if (free.count > 0)
    result.reason += text(stress(problem), ", displacement up to ", free.count, " motions that the contacts that hold leave free",
                          free.motions.cols() > 0 ? ", one of them " + describe(problem::body_motions(problem), Vector(free.motions.col(0))) : "");
  else
    result.reason += resisted_by_cells(scene, model, problem, free, result.state.lambda);
  open_without_force(problem, result);
}

}  // namespace dotyk::scene
