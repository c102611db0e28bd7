#include "shape/design/design_state.hpp"

namespace dotyk::shape {
namespace {

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
