#include "shape/derivative/quantity.hpp"

#include <algorithm>
#include <cmath>

#include "problem/uniqueness.hpp"
#include "base/error.hpp"
#include "elasticity/shape_derivative.hpp"
#include "scene/result/load_derivative.hpp"

namespace dotyk::shape {
namespace {

using algebra::Vector;

void require_given(const problem::Problem& problem) {
  for (const problem::FrictionGroup& group : problem.friction)
    for (int p = 0; p < group.points(); ++p)
      if (group.law->follows(p))
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
    if (problem::has_coulomb(state.solution()->model().problem))
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

/// S = Σ w (p/p̂)^q over all contacts' nodes, p̂ the peak.
struct Sum {
  double peak = 0, value = 0;
  std::vector<std::vector<ContactValue>> nodes;  ///< contact → row; empty for glue
};

class PeakPressure final : public Quantity {
 public:
  explicit PeakPressure(double exponent) : q_(exponent) {}
  std::string name() const override { return "peak_pressure"; }

  double value(const DesignState& state) const override {
    return smoothed(state, sum(*state.solution(), [](int, double force) { return force; }));
  }

  Vector gradient(const DesignState& state) const override {
    const std::vector<int>& weak = state.sensitivity().weak();
    const scene::Solution& solution = *state.solution();
    // Forces of weak contact are rounding.
    const Sum s = sum(solution, [&](int row, double force) { return std::find(weak.begin(), weak.end(), row) != weak.end() ? 0 : force; });
    if (s.peak == 0) return from_rest(state);
    Vector gradient = Vector::Zero(state.space().variables());
    // P = p̂ (S/|Γ|)^{1/q},  dP = P/S Σ (p/p̂)^{q−1} (dλ/p̂ + (1/q − 1) (p/p̂) dw)
    const double factor = value(state) / s.value;
    Vector by_lambda = Vector::Zero(solution.rows());
    for_each(s, solution, [&](int, std::size_t, int row, double ratio) { by_lambda[row] += factor * std::pow(ratio, q_ - 1) / s.peak; });
    if (state.sensitivity().smooth()) {
      const Adjoint adjoint = state.adjoint(Vector::Zero(solution.unknowns()), by_lambda);
      for (int i = 0; i < gradient.size(); ++i) gradient[i] = adjoint.along(state.change(i));
    } else {
      for (int i = 0; i < gradient.size(); ++i) gradient[i] = by_lambda.dot(state.derivative(i).lambda);
    }
    for (int i = 0; i < gradient.size(); ++i) {
      std::vector<std::vector<double>> weights(s.nodes.size());
      for (std::size_t c = 0; c < weights.size(); ++c)
        if (!s.nodes[c].empty()) weights[c] = weight_changes(solution, static_cast<int>(c), state.space().variable(i));
      for_each(s, solution, [&](int c, std::size_t k, int, double ratio) {
        gradient[i] += factor * (1 / q_ - 1) * std::pow(ratio, q_) * weights[static_cast<std::size_t>(c)][k];
      });
    }
    return gradient;
  }

 private:
  static double contact_length(const scene::Scene& scene) {
    double length = 0;
    for (const auto& contact : scene.contacts) {
      if (contact->kind != scene::Contact::Kind::contact) continue;
      if (contact->discretisation.multipliers != contact::Multipliers::nodal)
        throw InputError("peak_pressure is for nodal multipliers; " + contact->name + " has others");
      for (const contact::ContactRow& row : contact->rows) length += row.weight;
    }
    if (!(length > 0)) throw InputError("peak_pressure needs a contact, and the scene has none");
    return length;
  }

  /// Each node with the force(row of B, or -1; its own force).
  template <class Force>
  Sum sum(const scene::Solution& solution, Force&& force) const {
    Sum s;
    for (std::size_t c = 0; c < solution.scene().contacts.size(); ++c) {
      const bool glue = solution.scene().contacts[c]->kind != scene::Contact::Kind::contact;
      s.nodes.push_back(glue ? std::vector<ContactValue>{} : contact_values(solution, static_cast<int>(c)));
      for (std::size_t k = 0; k < s.nodes.back().size(); ++k) {
        ContactValue& node = s.nodes.back()[k];
        node.force = force(solution.model().contact_row[c][k], node.force);
        s.peak = std::max(s.peak, node.pressure());
      }
    }
    if (s.peak == 0) return s;
    for (const auto& list : s.nodes)
      for (const ContactValue& node : list)
        if (node.force > 0 && node.weight > 0) s.value += node.weight * std::pow(node.pressure() / s.peak, q_);
    return s;
  }

  double smoothed(const DesignState& state, const Sum& s) const {
    return s.peak * std::pow(s.value / contact_length(state.space().first()), 1 / q_);
  }

  /// Where nothing presses, P' along a variable is the P of the pressures' derivatives λ'/w ≥ 0 (not linear in the direction).
  Vector from_rest(const DesignState& state) const {
    Vector gradient = Vector::Zero(state.space().variables());
    for (int i = 0; i < gradient.size() && !state.sensitivity().smooth(); ++i) {
      const Vector& lambda = state.derivative(i).lambda;
      gradient[i] = smoothed(state, sum(*state.solution(), [&](int row, double) { return row < 0 ? 0 : lambda[row]; }));
    }
    return gradient;
  }

  /// visit(contact, node, row of B, p/p̂) for every node that presses; for q = 1, which is linear, for all.
  template <class Visit>
  void for_each(const Sum& s, const scene::Solution& solution, Visit&& visit) const {
    for (std::size_t c = 0; c < s.nodes.size(); ++c)
      for (std::size_t k = 0; k < s.nodes[c].size(); ++k) {
        const ContactValue& node = s.nodes[c][k];
        const int row = node.force > 0 || q_ == 1 ? solution.model().contact_row[c][k] : -1;
        if (row >= 0 && node.weight > 0) visit(static_cast<int>(c), k, row, node.pressure() / s.peak);
      }
  }

  double q_;
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

std::vector<ContactValue> contact_values(const scene::Solution& solution, int index) {
  std::vector<ContactValue> values;
  for (const scene::ContactNode& node : solution.contact(*solution.scene().contacts[static_cast<std::size_t>(index)]).nodes) values.push_back({node.force, node.gap, node.weight});
  return values;
}

std::vector<ContactValue> contact_derivatives(const scene::Solution& solution, int index, const Velocities& V, const Derivative& derivative) {
  const std::vector<double> weights = weight_changes(solution, index, V);
  const std::vector<int>& row = solution.model().contact_row[static_cast<std::size_t>(index)];
  std::vector<ContactValue> derivatives(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k) {
    derivatives[k].weight = weights[k];
    if (row[k] < 0) continue;
    derivatives[k].force = derivative.lambda[row[k]];
    derivatives[k].gap = -derivative.x[row[k]];
  }
  return derivatives;
}

std::shared_ptr<const Quantity> peak_pressure(double exponent) {
  if (!(exponent >= 1) || !std::isfinite(exponent)) throw InputError("the exponent of peak_pressure must be 1 or greater, and finite");
  return std::make_shared<PeakPressure>(exponent);
}

}  // namespace dotyk::shape
