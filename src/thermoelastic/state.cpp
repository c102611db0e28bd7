// What a thermoelastic beam does at its present time; supports that break (P4, section 4).
#include <algorithm>

#include "base/error.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::thermoelastic {
namespace {

using beam::Hermite;

/// (u, ℓu') at both ends as (u, u').
Eigen::Vector4d slopes(const Eigen::Vector4d& u, double unit) { return {u[0], u[1] / unit, u[2], u[3] / unit}; }

/// Values and slopes of M at both ends from the forces and moments on them.
Eigen::Vector4d moments(const CellVector& g, double unit) { return {unit * g[1], -g[0], -unit * g[3], g[2]}; }

constexpr int kHalvings = 33;     // of a step, to find when a support breaks: 1e-10 of it
constexpr double kEqual = 1e-9;  // forces whose relative difference may be rounding

/// The ratio of a breaking support's reaction to its limit; 0 for other laws.
double share_of_limit(const Held& held, double reaction) {
  const double r = held.turn * reaction * held.unit;
  return held.law->breaks && r > 0 ? r / held.law.bound() : 0;
}

}  // namespace

CellVector Stepping::Place::u() const { return group.now.u.segment(part.first + 2 * cell, part.effect.cell_unknowns()); }

Eigen::Vector4d Stepping::Place::theta() const { return group.now.theta.segment<4>(part.first_heat + 2 * cell); }

Hermite Stepping::Place::shape() const { return {s, part.effect.h(cell)}; }

CellVector Stepping::Place::end_forces() const {
  const CellStrain B = part.effect.strain_matrix(cell);
  const Eigen::Vector2d stress =
      part.effect.modulus()[cell] * (B * u() - part.effect.beta()[cell] * group.model->heat.projection(cell) * theta());
  const std::size_t index = static_cast<std::size_t>(&part - group.model->parts.data());
  return part.effect.h(cell) * B.transpose() * stress - group.forces.on_cells[index].col(cell);
}

Stepping::Place Stepping::place(Effect::Kind kind, double x) const {
  for (const auto& group : groups_)
    for (const Part& part : group.model->parts)
      if (part.effect.kind() == kind) {
        const auto [cell, s] = beam::place(group.model->heat.nodes(), x);
        return {group, part, cell, s};
      }
  throw std::logic_error("no such effect");
}

double Stepping::deflection(double x) const {
  const Place at = place(Effect::Kind::bending, x);
  return at.shape().value.dot(slopes(at.u(), data().length));
}

double Stepping::rotation(double x) const {
  const Place at = place(Effect::Kind::bending, x);
  return at.shape().slope.dot(slopes(at.u(), data().length));
}

double Stepping::displacement(double x) const {
  const Place at = place(Effect::Kind::stretching, x);
  return quadratic(at.s).dot(at.u());
}

double Stepping::gradient(double x) const {
  const Place at = place(Effect::Kind::bending, x);
  return at.shape().value.dot(slopes(at.theta(), data().length));
}

double Stepping::temperature(double x, double z) const {
  if (!(std::abs(z) <= data().height / 2))
    throw InputError(text("z = ", z, " is not within the beam, whose height is ", data().height));
  const Place at = place(Effect::Kind::stretching, x);
  return at.shape().value.dot(slopes(at.theta(), data().length)) + (z == 0 ? 0 : z * gradient(x));
}

double Stepping::moment(double x) const {
  const Place at = place(Effect::Kind::bending, x);
  return at.shape().value.dot(moments(at.end_forces(), data().length));
}

double Stepping::shear(double x) const {
  const Place at = place(Effect::Kind::bending, x);
  return at.shape().slope.dot(moments(at.end_forces(), data().length));
}

double Stepping::normal(double x) const {
  const Place at = place(Effect::Kind::stretching, x);
  const CellVector g = at.end_forces();
  return -(1 - at.s) * g[0] + at.s * g[2];
}

Reaction Stepping::reaction(int support) const {
  Reaction out;
  out.driven = groups_.front().forces.supports[support];
  std::array<double, 3> force{};
  for (int k = 0; k < 3; ++k) force[k] = out.driven[k].force;
  for (const auto& group : groups_)
    for (std::size_t p = 0; p < group.model->parts.size(); ++p) {
      const Part& part = group.model->parts[p];
      for (std::size_t i = 0; i < part.held.size(); ++i) {
        const Held& held = part.held[i];
        if (held.support != support) continue;
        force[static_cast<int>(held.what)] += group.now.reactions[p][static_cast<int>(i)] * held.unit + 0.0;  // no −0
      }
    }
  out.force = force[0], out.moment = force[1], out.axial = force[2];
  const double x = data().supports[support].x;
  out.deflection = deflection(x);
  out.rotation = rotation(x);
  out.displacement = displacement(x);
  return out;
}

void Stepping::telling(std::size_t first, const std::function<void()>& run) const {
  try {
    run();
  } catch (const InputError& error) {
    std::string names;
    for (std::size_t i = first; i < broken_.size(); ++i) names += (names.empty() ? "" : ", ") + broken_[i].name;
    throw InputError(text("after a support broke at t = ", broken_.back().time, " (", names, "): ", error.what()));
  }
}

void Stepping::Group::take(Model with, bool decompose) {
  model = std::make_shared<const Model>(std::move(with));
  decomposed.clear();
  for (const Part& part : model->parts) decomposed.push_back(decompose && determinate(part));
  always_decomposed = true;
  system.reset();
  whole.reset();
}

double Stepping::Group::overload(const std::vector<algebra::Vector>& reactions) const {
  double most = 0;
  for (std::size_t p = 0; p < model->parts.size(); ++p)
    for (std::size_t i = 0; i < model->parts[p].held.size(); ++i)
      most = std::max(most, share_of_limit(model->parts[p].held[i], reactions[p][static_cast<int>(i)]));
  return most;
}

std::vector<std::string> Stepping::Group::break_worst(bool decompose) {
  const double least = (1 - kEqual) * overload(now.reactions);
  std::vector<std::string> names;
  Model with = *model;
  for (std::size_t p = 0; p < with.parts.size(); ++p) {
    std::vector<Held> left;
    for (std::size_t i = 0; i < with.parts[p].held.size(); ++i) {
      const Held& held = with.parts[p].held[i];
      if (share_of_limit(held, now.reactions[p][static_cast<int>(i)]) < least) left.push_back(held);
      else names.push_back(held.name);
    }
    with.parts[p].held = std::move(left);
  }
  take(std::move(with), decompose);
  return names;
}

double Stepping::overload(const std::vector<Stage>& ends) const {
  double most = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i) most = std::max(most, groups_[i].overload(ends[i].fields.reactions));
  return most;
}

void Stepping::break_within(double tau, const Loads& loads, Monitor& monitor) {
  Work work = work_;
  double bears = 0, breaks = tau;
  for (int i = 0; i < kHalvings; ++i) {
    monitor.check();
    const double middle = (bears + breaks) / 2;
    (overload(trial(middle, loads, work, monitor)) > kBears ? breaks : bears) = middle;
  }
  accept(trial(breaks, loads, work, monitor), breaks, work);
  telling(broken_.size(), [&] {
    for (Group& group : groups_) break_supports(group, monitor);
    if (breaks < tau) advance(tau - breaks, loads, monitor);
  });
}

void Stepping::break_supports(Group& group, Monitor& monitor) {
  while (group.overload(group.now.reactions) > kBears) {
    const double stored = group.stored(group.now, group.forces);
    for (const std::string& name : group.break_worst(scheme_.decompose)) broken_.push_back({name, time_});
    Fields to = solve(group, group.forces, group.entropy, time_, 0, true, work_, monitor);
    const algebra::Vector entropy = group.model->entropy(to.u, to.theta);
    double put_in = group.forces.f.dot(to.u - group.now.u);
    for (const HeldTemperature& held : group.model->held_heat)
      put_in += (entropy - group.entropy)[held.unknown] * to.theta[held.unknown];
    energy_.put_in += put_in;
    energy_.released += stored + put_in - group.stored(to, group.forces);
    group.now = std::move(to);
    group.entropy = entropy;
    group.rates.reset();
  }
}

}  // namespace dotyk::thermoelastic
