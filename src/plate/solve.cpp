#include "plate/solve.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "plate/solvable.hpp"
#include "solver/pdas.hpp"

namespace dotyk::plate {

using algebra::Vector;

namespace {

/// Beyond so many unknowns that rows act on the dense condensed problem costs more than a sparse factorisation an iteration.
constexpr int kMostCondensed = 6000;

bool few_rows(const problem::Problem& problem) {
  std::vector<char> touched(problem.unknowns(), 0);
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) touched[it.col()] = 1;
  return std::count(touched.begin(), touched.end(), 1) <= kMostCondensed;
}

solver::Result run(const problem::Problem& problem, const solver::Method& method, Monitor& monitor) {
  if (problem.rows() == 0) return solver::solve_linear(problem, method.ordering(), monitor);
  if (method) return method.run(problem, {}, monitor);
  solver::Pdas pdas;
  pdas.reduced = few_rows(problem);
  return solver::solve(problem, pdas, monitor);
}

/// Takes off the part in the three motions, so that (u, 1) = (u, x) = (u, y) = 0 over the plate.
void normalise(const Model& model, Vector& unknowns) {
  const algebra::DenseMatrix R = model.space.motions();
  Plate with;
  with.mesh = std::shared_ptr<const mesh::Mesh>(std::shared_ptr<void>(), model.space.mesh);
  algebra::DenseMatrix moments(R.rows(), 3);
  const Eigen::Vector2d centre = model.space.centre();
  for (int i = 0; i < 3; ++i) {
    with.f_of = [&, i](double x, double y) { return i == 0 ? 1 : (i == 1 ? x - centre[0] : y - centre[1]) / model.space.unit; };
    moments.col(i) = loads(with, model.space);
  }
  unknowns -= R * (moments.transpose() * R).inverse() * (moments.transpose() * unknowns);
}

void refuse_noise(const problem::Residual& r, solver::Result& result) {
  if (!result.converged) return;
  const double allowed = std::max(result.noise, result.penalty || result.feti ? 0 : result.asked);
  if (r.equilibrium <= allowed) return;
  result.converged = false;
  result.reason = text("the equilibrium residual is ", r.equilibrium, ": what rounding leaves is no solution; ", result.reason);
}

}  // namespace

std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor) {
  Stopwatch total;
  const Verdict verdict = require_solvable(*model);
  solver::Result result = run(model->problem, method, monitor);
  if (!verdict.note.empty() && result.reason.find("unique up to") == std::string::npos) result.reason += "; " + verdict.note;
  if (model->problem.rows() == 0 && model->problem.blocks.front().kernel.cols() == 3) normalise(*model, result.state.u);
  std::optional<Family> all;
  if (verdict.motion && result.converged) all = family(*model, result.state, *verdict.motion);
  refuse_noise(problem::residual(model->problem, result.state), result);
  result.clock.assembly += model->seconds;
  result.clock.total = model->seconds + total.seconds();
  return std::make_shared<const Solution>(std::move(model), std::move(result), std::move(all));
}

}  // namespace dotyk::plate
