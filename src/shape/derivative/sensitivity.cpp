#include "shape/derivative/sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "scene/result/load_derivative.hpp"

namespace dotyk::shape {
namespace {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

/// Ten times the residual that the solution's multipliers leave in their laws is more than each of them is wrong by.
constexpr double kResiduals = 10;
/// A load's work on a motion that no row notices, relative to the sum of its parts without signs: rounding below this.
constexpr double kBalanced = 1e-9;

/// The problem without its matrices.
Problem without_stiffness(const Problem& problem) {
  Problem light;
  for (const problem::Block& block : problem.blocks)
    light.blocks.push_back({block.name, {}, block.f, 0, {}, block.kernel, block.motions, block.first});
  light.B = problem.B;
  light.c = problem.c;
  return light;
}

void require_finite(const scene::Solution& solution, const Velocities& velocities) {
  for (std::size_t b = 0; b < velocities.size(); ++b)
    if (!std::all_of(velocities[b].begin(), velocities[b].end(), [](double v) { return std::isfinite(v); }))
      throw InputError(text("a velocity of '", solution.body(static_cast<int>(b)).name, "' is not a finite number"));
}

}  // namespace

void require_solution(const scene::Solution& solution) {
  const solver::Result& result = solution.result();
  if (!result.converged) throw InputError("the solution has not converged; derivatives are those of a solution (" + result.reason + ")");
  if (result.penalty) throw InputError("the solution is one of a penalised problem; solve by a method without penalty, pdas or newton");
}

Sensitivity::Sensitivity(std::shared_ptr<const scene::Solution> solution, std::shared_ptr<problem::Condenser> condenser,
                         const Settings& settings, Monitor& monitor)
    : solution_(std::move(solution)), condenser_(std::move(condenser)), settings_(settings), monitor_(monitor) {
  require_differentiable();
  const Problem& problem = solution_->model().problem;
  const problem::State& state = solution_->result().state;
  const double error = problem::natural_residual(problem, problem::jumps(problem, state.u), state.lambda, solution_->measure().stiffness());
  law_ = law_derivative(problem, state, settings.touching, kResiduals * error * state.lambda.norm());
  if (!condenser_) condenser_ = std::make_shared<problem::Condenser>();
  rigid_ = problem::rigid_motions(problem);
  const CondensedProblem& condensed = condenser_->condense(problem, rigid_, settings.ordering, clock_, monitor);
  problem_ = without_stiffness(problem);
  const Bordered bordered(condensed, law_);
  if (smooth())
    factor_.emplace(bordered);
  else
    bordered_.emplace(bordered);
}

void Sensitivity::require_differentiable() const {
  require_solution(*solution_);
  const solver::Result& result = solution_->result();
  const Problem& problem = solution_->model().problem;
  for (const problem::Block& block : problem.blocks)
    if (block.K.rows() != block.size())
      throw InputError("the solution is an earlier step of a history, whose stiffness is not kept; derivatives are those of the last step");
  const Vector x = problem::jumps(problem, result.state.u), before = solution_->slip() - x;
  for (const problem::FrictionGroup& group : problem.friction)
    for (int i = group.first; i < group.first + group.points() * group.components; ++i)
      if (std::abs(before[i]) > 1e-12 * std::abs(solution_->slip()[i]))
        throw InputError(group.name + ": its slip goes on from an earlier step, whose own derivative would be needed; solve in one step");
}

std::string Sensitivity::weak_text() const {
  std::vector<std::string> rows;
  for (const int r : weak()) rows.push_back(solution_->model().problem.row_name(r));
  return listed(rows, 4);
}

Change Sensitivity::change(const Velocities& velocities) const {
  scene::require_differentiable(solution_->scene(), velocities);
  require_finite(*solution_, velocities);
  const scene::Model& model = solution_->model();
  RowChanges rows = row_changes(*solution_, velocities);
  Change change{Vector::Zero(solution_->unknowns()), std::move(rows.c), std::move(rows.bound)};
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    const int body = static_cast<int>(b);
    std::vector<double> nodal(solution_->displacement(body).size(), 0.0);
    if (!velocities[b].empty()) {
      const scene::Body& on = solution_->body(body);  // its loads have their factors already
      nodal = scene::load_derivative(on, {}, velocities[b]);
      const auto inner = scene::internal_force_derivative(on, solution_->displacement(body), velocities[b]);
      for (std::size_t k = 0; k < nodal.size(); ++k) nodal[k] -= inner[k];
    }
    const std::vector<int>& unknown = model.numbering[b].unknown;
    for (std::size_t k = 0; k < nodal.size(); ++k)
      if (unknown[k] >= 0) change.f[model.problem.blocks[b].first + unknown[k]] = nodal[k] - rows.force[b][k];
  }
  return change;
}

/// Puts a load and gaps on the condensed problem. Throws InputError where no row notices a motion on which the load, `what`, does
/// work.
const CondensedProblem& Sensitivity::load(const Vector& f, const Vector& c, const char* what) const {
  for (problem::Block& block : problem_.blocks) block.f = f.segment(block.first, block.size());
  problem_.c = c;
  problem::take_load(problem_, rigid_);
  const Vector work = rigid_.unnoticed.transpose() * rigid_.e;
  for (Eigen::Index k = 0; k < work.size(); ++k) {
    const Vector motion = problem::displacement(problem_, rigid_.unnoticed.col(k)).col(0);
    if (std::abs(work[k]) > kBalanced * motion.cwiseAbs().dot(f.cwiseAbs()))
      throw InputError(text("nothing holds ", describe(rigid_.motions, Vector(rigid_.unnoticed.col(k))), ", on which ", what, " does the work ", work[k],
                            ": there is no derivative; hold the body along it"));
  }
  return condenser_->condense(problem_, rigid_, settings_.ordering, clock_, monitor_);
}

/// (y, α) for the right side b; weak contact by the quadratic program, which tells what closes.
Vector Sensitivity::follow(const Vector& b) const {
  if (factor_) return factor_->solve(b);
  if (!law_.symmetric)
    throw InputError("weak contact (no force) at " + weak_text() + ", and Coulomb friction that slips elsewhere: no quadratic program tells "
                     "how the two go on; the solution's derivative is not known there");
  const std::vector<int> kept = closing(*bordered_, law_.weak, b, monitor_);
  const Eigen::Index n = static_cast<Eigen::Index>(kept.size()), modes = b.size() - bordered_->unknowns;
  Vector some(n + modes), all = Vector::Zero(b.size());
  for (Eigen::Index j = 0; j < n; ++j) some[j] = b[kept[static_cast<std::size_t>(j)]];
  some.tail(modes) = b.tail(modes);
  some = BorderedFactor(bordered_->restricted(kept)).solve(some);
  for (Eigen::Index j = 0; j < n; ++j) all[kept[static_cast<std::size_t>(j)]] = some[j];
  all.tail(modes) = some.tail(modes);
  require_complementary(*bordered_, law_.weak, b, all);
  return all;
}

Derivative Sensitivity::along(const Change& change) const {
  const CondensedProblem& condensed = load(change.f, change.c, "the change of loads and shape");
  Vector given = Vector::Zero(condensed.rows());
  for (const Slip& slip : law_.slips) given.segment(slip.row, slip.direction.size()) = change.bound[slip.row] * slip.direction;
  const Eigen::Index n = law_.size(), modes = condensed.kernel_size();
  Vector b(n + modes);
  b.head(n) = law_.F.transpose() * condensed.jump(given, {});
  if (modes > 0) b.tail(modes) = condensed.e() - condensed.N().transpose() * given;
  const Vector solved = follow(b), alpha = solved.tail(modes);
  Derivative d;
  d.lambda = law_.E * solved.head(n) + given;
  d.u = condensed.recover(d.lambda, alpha);
  d.x = solution_->model().problem.B * d.u - change.c;
  const scene::Model& model = solution_->model();
  for (std::size_t body = 0; body < model.numbering.size(); ++body) {
    const elasticity::Numbering& numbering = model.numbering[body];
    const Vector own = d.u.segment(model.problem.blocks[body].first, numbering.count());
    d.displacement.push_back(scene::spread(numbering, own, std::vector<double>(numbering.unknown.size(), 0.0)));
  }
  return d;
}

// J' = duᵀz + dλᵀμ. With K p + BᵀFq = du and Eᵀ(Bp − dλ) = Cq this is pᵀf̃ + (Fq)ᵀc̃ + Σ g'_p d_pᵀ(dλ − Bp)_p: the same kind of problem
// with the load du, the gaps dλ, and E and F exchanged.
Adjoint Sensitivity::adjoint(const Vector& du, const Vector& dlambda) const {
  const Problem& problem = solution_->model().problem;
  if (du.size() != problem.unknowns() || (dlambda.size() != 0 && dlambda.size() != problem.rows()))
    throw InputError(text("the gradient is of ", du.size(), " unknowns and ", dlambda.size(), " rows; there are ", problem.unknowns(), " and ",
                          problem.rows()));
  if (!smooth())
    throw InputError("weak contact (no force) at " + weak_text() + ": the derivative is not linear in the nodes' motion there, and has no "
                     "gradient; ask for it along each motion");
  const Vector gaps = dlambda.size() ? dlambda : Vector::Zero(problem.rows());
  const CondensedProblem& condensed = load(du, gaps, "the gradient by displacements");
  const Eigen::Index n = law_.size(), modes = condensed.kernel_size();
  Vector b(n + modes);
  b.head(n) = law_.E.transpose() * condensed.x0();
  // The matrix with E and F exchanged is the transposed one, with the signs of α's rows and columns changed.
  if (modes > 0) b.tail(modes) = -condensed.e();
  const Vector solved = factor_->solve_transposed(b), alpha = -solved.tail(modes);
  Adjoint a;
  a.c = law_.F * solved.head(n);
  a.f = condensed.recover(a.c, alpha);
  a.bound = Vector::Zero(problem.rows());
  const Vector rest = gaps - problem.B * a.f;
  for (const Slip& slip : law_.slips) a.bound[slip.row] = slip.direction.dot(rest.segment(slip.row, slip.direction.size()));
  return a;
}

}  // namespace dotyk::shape
