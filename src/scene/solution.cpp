#include "scene/solution.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "scene/locate.hpp"

namespace dotyk::scene {

using mesh::Point;

Solution::Solution(std::shared_ptr<const Scene> scene, Model model, solver::Result result)
    : scene_(std::move(scene)), contacts_(scene_->contacts), model_(std::move(model)),
      result_(std::move(result)), stress_(scene_->bodies.size()), locators_(scene_->bodies.size()) {
  if (!result_.state.u.allFinite() || !result_.state.lambda.allFinite())
    throw std::runtime_error(
        "the solution has values that are not finite: stiffness, loads or sizes are out of range");
  residual_ = problem::residual(model_.problem, result_.state);
  energy_ = problem::energy(model_.problem, result_.state);
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b)
    displacement_.push_back(model_.displacement(static_cast<int>(b), result_.state.u));
}

Solution::~Solution() = default;

const std::vector<elasticity::Stress>& Solution::stress(int body) const {
  if (stress_[body].empty()) {
    Stopwatch watch;
    const Body& b = *scene_->bodies[body];
    stress_[body] = elasticity::recover_stress(
        *b.mesh, elasticity::cell_stress(*b.mesh, b.material, displacement_[body]));
    result_.clock.recover += watch.seconds();
    result_.clock.total += watch.seconds();
  }
  return stress_[body];
}

const Locator& Solution::locator(int body) const {
  if (!locators_[body]) locators_[body] = std::make_unique<Locator>(*scene_->bodies[body]->mesh);
  return *locators_[body];
}

namespace {

Place place(const Locator& locator, const Body& body, const Point& x) {
  const auto found = locator.find(x);
  if (!found)
    throw InputError(text("the point ", point_text(x.data(), body.dimension()), " lies outside '",
                          body.name, "' at rest"));
  return *found;
}

}  // namespace

Point Solution::displacement(int body, const Point& x) const {
  const Body& b = *scene_->bodies[body];
  const Place at = place(locator(body), b, x);
  Point u{0, 0, 0};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    for (int i = 0; i < b.dimension(); ++i)
      u[i] += at.shape[a] * displacement_[body][static_cast<std::size_t>(b.mesh->cell(at.cell)[a]) * b.dimension() + i];
  return u;
}

elasticity::Stress Solution::stress(int body, const Point& x) const {
  const Body& b = *scene_->bodies[body];
  const Place at = place(locator(body), b, x);
  const auto& nodal = stress(body);
  elasticity::Stress s{};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    for (std::size_t v = 0; v < s.size(); ++v) s[v] += at.shape[a] * nodal[b.mesh->cell(at.cell)[a]][v];
  return s;
}

bool Solution::active(int row) const {
  return !result_.active_sets.empty() && result_.active_sets.back()[row];
}

double Solution::error_estimate() const {
  elasticity::EnergyEstimate sum;
  for (std::size_t k = 0; k < scene_->bodies.size(); ++k) {
    const Body& b = *scene_->bodies[k];
    const auto e = elasticity::estimate_error(*b.mesh, b.material, displacement_[k], stress(static_cast<int>(k)));
    sum.error_squared += e.error_squared;
    sum.solution_squared += e.solution_squared;
  }
  const double whole = sum.error_squared + sum.solution_squared;
  return whole > 0 ? std::sqrt(sum.error_squared / whole) : 0;
}

std::string describe(const Solution& s) {
  const solver::Result& r = s.result();
  std::string out = text("solution: ", r.converged ? "converged" : "NOT CONVERGED", " (", r.method, ", ",
                         r.iterations, r.iterations == 1 ? " iteration" : " iterations", "; ", r.reason, ")\n");
  out += text("  unknowns ", s.unknowns(), ", rows ", s.rows(), ", energy ", s.energy(), "\n");
  out += text("  residual: equilibrium ", s.residual().equilibrium, ", penetration ", s.residual().penetration,
              ", complementarity ", s.residual().complementarity, "\n");
  for (const auto& contact : s.scene().contacts) {
    if (contact->kind != Contact::Kind::contact) continue;
    const ContactResult c = s.contact(*contact);
    out += text("  ", contact->name, ": force ", point_text(c.force.data(), s.scene().dimension()), ", ",
                c.closed, " closed, ", c.open, " open, greatest pressure ", c.max_pressure, "\n");
  }
  const problem::Clock& t = s.clock();
  out += text("  seconds: total ", t.total, " (assembly ", t.assembly, ", ordering ", t.ordering, ", factor ",
              t.factor, ", iterate ", t.iterate, ", recover ", t.recover, ")");
  return out;
}

}  // namespace dotyk::scene
