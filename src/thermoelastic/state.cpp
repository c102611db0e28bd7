// What a thermoelastic beam does at its present time.
#include "base/error.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::thermoelastic {

using beam::Hermite;

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

namespace {

/// (u, ℓu') at both ends as (u, u').
Eigen::Vector4d slopes(const Eigen::Vector4d& u, double unit) { return {u[0], u[1] / unit, u[2], u[3] / unit}; }

/// Values and slopes of M at both ends from the forces and moments on them.
Eigen::Vector4d moments(const CellVector& g, double unit) { return {unit * g[1], -g[0], -unit * g[3], g[2]}; }

}  // namespace

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

}  // namespace dotyk::thermoelastic
