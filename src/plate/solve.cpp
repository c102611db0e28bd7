#include "plate/solve.hpp"

#include <algorithm>

#include "algebra/dense/lu.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "plate/auxiliary.hpp"
#include "plate/solvable.hpp"
#include "solver/core/settle.hpp"

namespace dotyk::plate {

using algebra::Vector;

namespace {

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
  unknowns -= R * algebra::Lu(moments.transpose() * R).solve(moments.transpose() * unknowns);
}

/// Edges apart from one another may bear the most that they can, one up and one down, and leave the plate free to move. All solutions then,
/// if they differ by one motion; the state becomes the least of them.
std::optional<Family> settled(const Model& model, solver::Result& result) {
  const problem::FreeMotions free = solver::settle(model.problem, Vector::Zero(result.state.u.size()), result);
  if (free.count != 1) return {};
  return family(model, result.state, of_freedoms(model, Vector(free.motions.col(0))));
}

/// What is known before in place of what methods say of it in general.
void tell(const std::string& note, std::string& reason) {
  if (note.empty()) return;
  for (const char* general : {"; unique up to", "; a limit case"}) reason.erase(std::min(reason.find(general), reason.size()));
  reason += "; " + note;
}

}  // namespace

std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor) {
  Stopwatch total;
  const Verdict verdict = require_solvable(*model);
  solver::Result result;
  std::optional<Family> all;
  std::optional<LimitCase> limit;
  if (verdict.motion && model->problem.rows() > 0) limit = solve_limit_case(*model, *verdict.motion, method, monitor);
  if (limit) {
    result = std::move(limit->result);
    all = std::move(limit->all);
  } else {
    result = run(model->problem, method, monitor);
    all = settled(*model, result);
    if (verdict.motion && result.converged && !all) all = family(*model, result.state, *verdict.motion);
  }
  tell(verdict.note, result.reason);
  if (model->problem.rows() == 0 && model->problem.blocks.front().kernel.cols() == 3) normalise(*model, result.state.u);
  result.clock.assembly += model->seconds;
  result.clock.total = model->seconds + total.seconds();
  return std::make_shared<const Solution>(std::move(model), std::move(result), std::move(all));
}

}  // namespace dotyk::plate
