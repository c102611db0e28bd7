#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/model/moved.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

namespace {

/// By contact row: has it closed from a gap?
std::vector<char> closed_on_the_way(const Solution& solution, std::size_t c) {
  const Contact& contact = *solution.model().contacts[c];
  const double touching = contact::kTouching * contact.first.body->mesh->size();
  std::vector<char> closed;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) {
    const int r = solution.model().contact_row[c][k];
    closed.push_back(r >= 0 && solution.active(r) && std::abs(contact.rows[k].gap) > touching);
  }
  return closed;
}

double force_of(const Solution& solution, const FrictionRows& rows) {
  double size = 0;
  for (int i = 0; i < rows.count; ++i) size = std::hypot(size, solution.result().state.lambda[rows.row[i]]);
  return size;
}

}  // namespace

std::optional<double> share_of_path(const Solution& solution) {
  bool follows = false, by_others = false;
  double stuck = 0, sum = 0;
  for (std::size_t c = 0; c < solution.model().contacts.size(); ++c) {
    if (solution.model().contacts[c]->tangential.kind != problem::SupportLaw::Kind::free) continue;  // springs have no memory
    const std::vector<char> closed = closed_on_the_way(solution, c);
    if (solution.model().friction[c].empty()) by_others = by_others || std::find(closed.begin(), closed.end(), 1) != closed.end();
    for (const FrictionRows& rows : solution.model().friction[c]) {
      const double force = force_of(solution, rows);
      sum += force;
      if (std::none_of(rows.cell.jumps.begin(), rows.cell.jumps.end(), [&](const contact::Term& jump) { return closed[static_cast<std::size_t>(jump.row)]; })) continue;
      follows = true;
      if (const auto& slips = solution.result().slipping; slips.empty() || !slips[rows.row[0]]) stuck += force;
    }
  }
  if (sum > 0 && by_others) return 1;  // where bodies went before another contact stopped them is not known
  if (!follows) return std::nullopt;
  return sum > 0 ? stuck / sum : 0;
}

namespace {

/// The scene with what its bodies bore when it was solved.
std::shared_ptr<Scene> as_solved(const Solution& solution) {
  auto scene = copy(solution.scene());
  for (std::size_t b = 0; b < scene->bodies.size(); ++b) {
    Body& body = *scene->bodies[b];
    const auto origin = body.origin;
    body = solution.body(static_cast<int>(b));
    body.origin = origin;
    for (LawSupport& law : body.laws)
      for (problem::SupportLaw* part : {&law.normal, &law.tangential})
        if (part->kind == problem::SupportLaw::Kind::load) part->value = 0;  // among the forces already
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
  if (!share_of_path(solution)) return 0;
  const auto scene = as_solved(solution);
  const Model& model = solution.model();
  std::vector<Step> steps;
  for (int k = 1; k <= Solution::kPathSteps; ++k) steps.push_back(part_of(static_cast<double>(k) / Solution::kPathSteps, *scene, model));
  const auto stepped = solve(scene, {}, {}, monitor, steps);
  if (!stepped->result().converged) throw InputError(text("path_error: ", Solution::kPathSteps, " load steps do not converge: ", stepped->result().reason));
  double apart = 0, sum = 0;
  for (const auto& contact : model.friction)
    for (const FrictionRows& rows : contact) {
      double d = 0, size = 0;
      for (int i = 0; i < rows.count; ++i) {
        const double one = solution.result().state.lambda[rows.row[i]], many = stepped->result().state.lambda[rows.row[i]];
        d = std::hypot(d, one - many), size = std::hypot(size, many);
      }
      apart += d, sum += size;
    }
  return sum > 0 ? apart / sum : 0;
}

}  // namespace

double Solution::path_error(Monitor& monitor) const {
  if (!path_error_) path_error_ = estimate_path_error(*this, monitor);
  return *path_error_;
}

}  // namespace dotyk::scene
