#include "scene/solve/after_solve.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "problem/free_motions.hpp"
#include "problem/residual.hpp"
#include "solver/core/settle.hpp"

namespace dotyk::scene {

using algebra::Vector;
using solver::kOnBound;

namespace {

/// Smaller ones are rounding.
constexpr double kRounding = 1e-12;
/// Half the width of contact, in cells, that does not tell a rotation from none.
constexpr double kNarrow = 1.5;

/// Rows whose multiplier is rounding bear nothing, nor do those where it is as good as none and which have parted.
void open_without_force(const problem::Problem& problem, solver::Result& result) {
  if (result.active_sets.empty()) return;
  const Vector& lambda = result.state.lambda;
  const Vector x = problem.B * result.state.u - problem.c;
  const Vector none = problem::small_forces(problem, lambda, kOnBound);
  const Vector compliance = problem.row_compliance();
  const std::vector<problem::Scales> scales = problem::scales(problem, result.state);
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      const problem::Scales& scale = scales[static_cast<std::size_t>(r)];
      const bool parted = x[r] < -kOnBound * scale.length;
      if (lambda[r] <= kRounding * scale.force || (parted && (lambda[r] <= none[r] || (lambda[r] <= 10 * kOnBound * scale.force && compliance[r] * lambda[r] <= -problem::kBesideGap * x[r])))) result.active_sets.back()[r] = 0;
    }
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

/// A rotation that contact hardly wider than its cells resists.
std::string resisted_by_cells(const Scene& scene, const Model& model, const problem::Problem& problem, const problem::FreeMotions& free,
                              const Vector& lambda) {
  if (free.weakest.size() == 0) return "";
  const auto motions = problem::body_motions(problem);
  Eigen::Index mode;
  free.weakest.cwiseAbs().maxCoeff(&mode);
  if (motions.size() != static_cast<std::size_t>(free.weakest.size()) || motions[mode].motion.kind != Motion::Kind::rotation) return "";
  for (const auto& body : scene.bodies)
    if (body->name == motions[mode].body && free.grip * body->mesh->size() / 2 <= kNarrow * widest_cell(scene, model, lambda))
      return text("; ", motions[mode].text(), " is resisted only by terms of the order of the mesh (contact is hardly wider than its cells): how far it goes "
                  "is the mesh's");
  return "";
}

}  // namespace

void settle(const Scene& scene, const Model& model, const problem::Problem& problem, const Vector& before, solver::Result& result) {
  if (!result.converged || problem.rows() == 0) return;
  const problem::FreeMotions free = solver::settle(problem, before, result);
  if (free.count == 0) result.reason += resisted_by_cells(scene, model, problem, free, result.state.lambda);
  open_without_force(problem, result);
}

}  // namespace dotyk::scene
