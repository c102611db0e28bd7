#include "base/error.hpp"
#include "elasticity/shape_derivative.hpp"
#include "shape/derivative/energy_derivative.hpp"
#include "shape/derivative/quantity.hpp"

namespace dotyk::shape {
namespace {

using algebra::Vector;

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

double volume_of(const scene::Scene& scene) {
  double sum = 0;  // div x = dimension
  for (const auto& body : scene.bodies) sum += elasticity::volume_derivative(*body->mesh, body->mesh->coordinates) / body->dimension();
  return sum;
}

std::shared_ptr<const Quantity> compliance() { return std::make_shared<Compliance>(); }
std::shared_ptr<const Quantity> volume() { return std::make_shared<Volume>(); }

}  // namespace dotyk::shape
