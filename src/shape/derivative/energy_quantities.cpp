#include "base/error.hpp"
#include "elasticity/shape_derivative.hpp"
#include "scene/result/load_derivative.hpp"
#include "shape/derivative/quantity.hpp"

namespace dotyk::shape {
namespace {

using algebra::Vector;

void require_given(const problem::Problem& problem) {
  for (const problem::FrictionGroup& group : problem.friction)
    for (int p = 0; p < group.points(); ++p)
      if (group.law->bound_slope(p) > 0)
        throw InputError(group.name + " has Coulomb friction, whose solutions are not those of least energy; differentiate the energy by "
                                      "its solution's derivative");
}

/// Σ g'_p ‖x_t‖.
double friction(const problem::Problem& problem, const algebra::Vector& x, const algebra::Vector& bound) {
  double sum = 0;
  for (const problem::FrictionGroup& group : problem.friction)
    for (int p = 0; p < group.points(); ++p) sum += bound[group.row(p)] * x.segment(group.row(p), group.components).norm();
  return sum;
}

class Compliance final : public Quantity {
 public:
  std::string name() const override { return "compliance"; }

  double value(const DesignState& state) const override {
    for (const auto& contact : state.scene().contacts)
      if (contact->friction == scene::Friction::Kind::coulomb)
        throw InputError("compliance is minus the least energy, and Coulomb's friction has none; take another quantity, a function of the design say");
    return -(state.solution()->energy() + state.solution()->friction_energy());
  }

  Vector gradient(const DesignState& state) const override {
    Vector gradient(state.space().variables());
    for (int i = 0; i < gradient.size(); ++i) gradient[i] = -energy_derivative(*state.solution(), state.space().variable(i));
    return gradient;
  }
};

class Volume final : public Quantity {
 public:
  std::string name() const override { return "volume"; }
  double value(const DesignState& state) const override {
    return volume_of(state.scene());
  }
  Vector gradient(const DesignState& state) const override {
    Vector gradient = Vector::Zero(state.space().variables());
    for (int i = 0; i < gradient.size(); ++i) {
      const Velocities& V = state.space().variable(i);
      for (std::size_t b = 0; b < V.size(); ++b)
        if (!V[b].empty()) gradient[i] += elasticity::volume_derivative(*state.scene().bodies[b]->mesh, V[b]);
    }
    return gradient;
  }
};

}  // namespace

double energy_derivative(const scene::Solution& solution, const Velocities& velocities) {
  const problem::Problem& problem = solution.model().problem;
  require_solution(solution);
  require_given(problem);
  scene::require_differentiable(solution.scene(), velocities);
  const RowChanges rows = row_changes(solution, velocities);
  const problem::State& state = solution.result().state;
  double sum = friction(problem, problem::jumps(problem, state.u), rows.bound) - state.lambda.dot(rows.c);
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    if (velocities[b].empty()) continue;
    const int body = static_cast<int>(b);
    const std::vector<double>& u = solution.displacement(body);
    const scene::Body& on = solution.body(body);  // its loads have their factors already
    const auto load = scene::load_derivative(on, {}, velocities[b]), inner = scene::internal_force_derivative(on, u, velocities[b]);
    for (std::size_t k = 0; k < u.size(); ++k) sum += u[k] * (0.5 * inner[k] - load[k]);
  }
  return sum;
}

double volume_of(const scene::Scene& scene) {
  double sum = 0;  // div x = dimension
  for (const auto& body : scene.bodies) sum += elasticity::volume_derivative(*body->mesh, body->mesh->coordinates) / body->dimension();
  return sum;
}

std::shared_ptr<const Quantity> compliance() { return std::make_shared<Compliance>(); }
std::shared_ptr<const Quantity> volume() { return std::make_shared<Volume>(); }

}  // namespace dotyk::shape
