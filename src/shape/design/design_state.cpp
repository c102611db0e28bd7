#include "shape/design/design_state.hpp"

#include <cmath>

#include "base/error.hpp"
#include "scene/model/moved.hpp"
#include "shape/derivative/boundary_motion.hpp"

namespace dotyk::shape {
namespace {

void require_velocities(const scene::Scene& scene, const Velocities& V, std::size_t variable) {
  const auto fail = [&](const auto&... why) { throw InputError(text("design variable ", variable + 1, " ", why...)); };
  if (V.size() != scene.bodies.size()) fail("has velocities of ", V.size(), " bodies; the scene has ", scene.bodies.size());
  bool moves = false;
  for (std::size_t b = 0; b < V.size(); ++b) {
    const scene::Body& body = *scene.bodies[b];
    if (!V[b].empty() && V[b].size() != body.mesh->coordinates.size())
      fail("has ", V[b].size(), " velocity components of '", body.name, "', which has ", body.mesh->coordinates.size(), " coordinates");
    for (const double v : V[b]) {
      if (!std::isfinite(v)) fail("moves a node of '", body.name, "' with the velocity ", v);
      moves = moves || v != 0;
    }
  }
  if (!moves) fail("moves nothing");
}

/// The contact rows that are closed.
std::vector<int> closed_rows(const scene::Solution& solution) {
  std::vector<int> closed;
  int row = 0;
  for (const auto& contact : solution.scene().contacts) {
    if (contact->kind != scene::Contact::Kind::contact) continue;
    for (const scene::ContactNode& node : solution.contact(*contact).nodes) {
      if (node.status != problem::Status::open) closed.push_back(row);
      ++row;
    }
  }
  return closed;
}

}  // namespace

DesignSpace::DesignSpace(std::shared_ptr<const scene::Scene> scene, std::vector<Velocities> variables)
    : scene_(std::move(scene)), variables_(std::move(variables)) {
  for (const auto& body : scene_->bodies) require_first_order(*body);
  if (variables_.empty()) throw InputError("a design needs variables: parts that move");
  for (std::size_t i = 0; i < variables_.size(); ++i) require_velocities(*scene_, variables_[i], i);
}

Velocities DesignSpace::along(const algebra::Vector& beta) const {
  Velocities sum(scene_->bodies.size());
  for (std::size_t i = 0; i < variables_.size(); ++i)
    for (std::size_t b = 0; b < sum.size(); ++b) {
      const std::vector<double>& V = variables_[i][b];
      if (!V.empty() && sum[b].empty()) sum[b].assign(V.size(), 0.0);
      for (std::size_t k = 0; k < V.size(); ++k) sum[b][k] += beta[static_cast<Eigen::Index>(i)] * V[k];
    }
  return sum;
}

std::shared_ptr<scene::Scene> DesignSpace::at(const algebra::Vector& alpha) const {
  Velocities points = along(alpha);
  for (std::size_t b = 0; b < points.size(); ++b) {
    const std::vector<double>& rest = scene_->bodies[b]->mesh->coordinates;
    for (std::size_t k = 0; k < points[b].size(); ++k) points[b][k] += rest[k];
  }
  return scene::moved(*scene_, points);
}

DesignState::DesignState(std::shared_ptr<const DesignSpace> space, algebra::Vector alpha, const solver::Method& method, const DesignState* near, std::shared_ptr<Cost> cost,
                         Monitor& monitor)
    : space_(std::move(space)), alpha_(std::move(alpha)), cost_(std::move(cost)), condenser_(std::make_shared<problem::Condenser>()),
      change_(static_cast<std::size_t>(space_->variables())), derivative_(change_.size()) {
  scene_ = space_->at(alpha_);
  scene::Start start;
  if (near) start.closed = closed_rows(*near->solution_);
  start.condenser = condenser_;
  solution_ = scene::solve(scene_, method, start, monitor);
  ++cost_->analyses;
  cost_->iterations += solution_->result().iterations;
}

DesignState::DesignState(const DesignState& state, const algebra::Vector& beta)
    : space_(std::make_shared<const DesignSpace>(state.space_->line(beta))), alpha_(state.alpha_),
      beta_(state.beta_.size() > 0 ? algebra::Vector(state.beta_ * beta[0]) : beta), cost_(state.cost_),
      condenser_(state.condenser_), scene_(state.scene_), solution_(state.solution_), change_(1), derivative_(1) {}

algebra::Vector DesignState::alpha_gradient(Eigen::Index k) const {
  if (beta_.size() > 0) return algebra::Vector::Constant(1, beta_[k]);
  return algebra::Vector::Unit(alpha_.size(), k);
}

const Sensitivity& DesignState::sensitivity() const {
  if (sensitivity_) return *sensitivity_;
  sensitivity_ = std::make_shared<const Sensitivity>(solution_, condenser_, Sensitivity::Settings{}, idle_);
  return *sensitivity_;
}

const Change& DesignState::change(int variable) const {
  auto& known = change_[static_cast<std::size_t>(variable)];
  if (known) return *known;
  const Sensitivity& s = sensitivity();
  known = s.change(space_->variable(variable));
  return *known;
}

const Derivative& DesignState::derivative(int variable) const {
  auto& known = derivative_[static_cast<std::size_t>(variable)];
  if (known) return *known;
  const Change& along = change(variable);
  known = sensitivity().along(along);
  ++cost_->derivatives;
  return *known;
}

Adjoint DesignState::adjoint(const algebra::Vector& du, const algebra::Vector& dlambda) const {
  const Sensitivity& s = sensitivity();
  Adjoint result = s.adjoint(du, dlambda);
  ++cost_->derivatives;
  return result;
}

}  // namespace dotyk::shape
