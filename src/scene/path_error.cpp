#include "scene/path_error.hpp"

#include <cmath>

#include "base/error.hpp"
#include "scene/moved.hpp"

namespace dotyk::scene {

bool follows_path(const Solution& solution) {
  const Model& model = solution.model();
  for (std::size_t c = 0; c < model.friction.size(); ++c)
    for (const FrictionRows& rows : model.friction[c])
      for (const contact::Term& jump : rows.cell.jumps) {
        const int r = model.contact_row[c][static_cast<std::size_t>(jump.row)];
        const Contact& contact = *model.contacts[c];
        const double touching = contact::kTouching * contact.first.body->mesh->size();
        if (r >= 0 && solution.active(r) && std::abs(contact.rows[static_cast<std::size_t>(jump.row)].gap) > touching) return true;
      }
  return false;
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

}  // namespace

double estimate_path_error(const Solution& solution, Monitor& monitor) {
  if (solution.follows()) throw InputError("path_error is of one load step from rest; this solution follows another: halve the steps and compare");
  if (!follows_path(solution)) return 0;
  const auto scene = as_solved(solution);
  const Model& model = solution.model();
  std::vector<Step> steps;
  for (int k = 1; k <= kPathSteps; ++k) steps.push_back(part_of(static_cast<double>(k) / kPathSteps, *scene, model));
  const auto stepped = solve(scene, {}, {}, monitor, steps);
  if (!stepped->result().converged) throw InputError(text("path_error: ", kPathSteps, " load steps do not converge: ", stepped->result().reason));
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

double Solution::path_error(Monitor& monitor) const {
  if (!path_error_) path_error_ = estimate_path_error(*this, monitor);
  return *path_error_;
}

}  // namespace dotyk::scene
