#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "scene/model/moved.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

namespace {

/// Has a row of a contact closed from a gap, or opened from a fit, on the way from rest?
bool closed_on_the_way(const Solution& solution, std::size_t c) {
  const Contact& contact = *solution.model().contacts[c];
  const double touching = contact::kTouching * contact.first.body->mesh->size();
  for (std::size_t k = 0; k < contact.rows.size(); ++k)
    if (const int r = solution.model().contact_row[c][k]; r >= 0 && solution.active(r) && std::abs(contact.rows[k].gap) > touching) return true;
  return false;
}

/// Is the solution at a part of the load that part of it? So it is with Coulomb friction and laws that are cones, where no gap closed.
bool in_proportion(const problem::Problem& problem) {
  const auto points = problem.friction_points();
  const auto rows = problem.scalar_rows();
  return std::all_of(points.begin(), points.end(), [](const problem::FrictionPoint& p) { return p.group.law->bound(p.k, 0) == 0; }) &&
         std::all_of(rows.begin(), rows.end(), [](const problem::ScalarRow& row) { return row.law.unilateral() || row.law.linear_stiffness(row.k); });
}

/// The scene with what its bodies bore when it was solved.
std::shared_ptr<Scene> as_solved(const Solution& solution) {
  auto scene = copy(solution.scene());
  for (std::size_t b = 0; b < scene->bodies.size(); ++b) {
    Body& body = *scene->bodies[b];
    const auto origin = body.origin;
    body = solution.body(static_cast<int>(b));
    body.origin = origin;
    for (LawSupport& law : body.laws)
      for (problem::LawAlong* part : {&law.normal, &law.tangential})
        if ((*part)->load) part->scale(0);  // among the forces already
  }
  return scene;
}

Step part_of(double share, const Scene& scene, const Model& model) {
  Step step;
  step.all = share;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    if (model.move[c] != mesh::Point{0, 0, 0}) step.move.emplace_back(scene.contacts[c], mesh::times(share, model.move[c]));
  return step;
}

double estimate_path_error(const Solution& solution, Monitor& monitor) {
  if (!solution.result().converged)
    throw InputError("the solution has not converged, so that path_error, which is of a solution, does not apply (" + solution.result().reason + ")");
  if (solution.follows()) throw InputError("path_error is of one load step from rest; this solution follows another: halve the steps and compare");
  if (!follows_path(solution) && in_proportion(solution.model().problem)) return 0;
  const auto scene = as_solved(solution);
  const Model& model = solution.model();
  std::vector<Step> steps;
  for (int k = 1; k <= Solution::kPathSteps; ++k) steps.push_back(part_of(static_cast<double>(k) / Solution::kPathSteps, *scene, model));
  const auto stepped = solve(scene, {}, {}, monitor, steps);
  if (!stepped->result().converged) throw InputError(text("path_error: ", Solution::kPathSteps, " load steps do not converge: ", stepped->result().reason));
  double apart = 0, sum = 0;
  for (const problem::FrictionPoint& p : model.problem.friction_points()) {
    const auto of = [&](const Solution& one) { return one.result().state.lambda.segment(p.first, p.group.components); };
    apart += (of(solution) - of(*stepped)).norm(), sum += of(*stepped).norm();
  }
  return sum > 0 ? apart / sum : 0;
}

}  // namespace

bool follows_path(const Solution& solution) {
  const problem::Problem& problem = solution.model().problem;
  const auto points = problem.friction_points();
  const bool rubs = std::any_of(points.begin(), points.end(), [&](const problem::FrictionPoint& p) {
    return !solution.result().state.lambda.segment(p.first, p.group.components).isZero(0);
  });
  for (std::size_t c = 0; rubs && c < solution.model().contacts.size(); ++c)
    if (closed_on_the_way(solution, c)) return true;
  return false;
}

double Solution::path_error(Monitor& monitor) const {
  if (!path_error_) path_error_ = estimate_path_error(*this, monitor);
  return *path_error_;
}

}  // namespace dotyk::scene
