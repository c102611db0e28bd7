#include "beam/solution.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "beam/element.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::beam {

Solution::Solution(Beam beam, Model model, solver::Result result)
    : beam_(std::move(beam)), model_(std::move(model)), result_(std::move(result)),
      residual_(solver::judge(model_.problem, result_)) {
  sum_loads();
}

void Solution::sum_loads() {
  forces_ = beam_.loads;
  for (std::size_t i = 0; i < beam_.supports.size(); ++i) {
    const Reaction r = reaction(static_cast<int>(i));
    forces_.push_back({model_.nodes[model_.supports[i].node], r.force, r.moment});
  }
  for (std::size_t i = 0; i < model_.foundation.size(); ++i) forces_.push_back({model_.nodes[i], foundation_force(static_cast<int>(i)), 0});
  sum_q_ = sum_moment_ = {0};
  for (std::size_t i = 0; i + 1 < model_.nodes.size(); ++i) {
    const double a = model_.nodes[i], b = model_.nodes[i + 1];
    sum_moment_.push_back(sum_moment_[i] + (b - a) * sum_q_[i] + moment_between(a, b));
    sum_q_.push_back(sum_q_[i] + force_between(a, b));
  }
}

/// ∫ q.
double Solution::force_between(double from, double to) const {
  return beam_.q_of ? integral(beam_.q_of, from, to) : beam_.q * (to - from);
}

/// ∫ (to − s) q(s) ds.
double Solution::moment_between(double from, double to) const {
  if (!beam_.q_of) return beam_.q * (to - from) * (to - from) / 2;
  return integral([&](double s) { return (to - s) * beam_.q_of(s); }, from, to);
}

Eigen::Vector4d Solution::values(int cell) const {
  const Eigen::Vector4d w = result_.state.u.here().segment<4>(2 * cell);
  return {w[0], w[1] / model_.unit, w[2], w[3] / model_.unit};
}

double Solution::deflection(double x) const {
  const auto [cell, s] = place(model_.nodes, x);
  return Hermite(s, model_.nodes[cell + 1] - model_.nodes[cell]).value.dot(values(cell));
}

double Solution::rotation(double x) const {
  const auto [cell, s] = place(model_.nodes, x);
  return Hermite(s, model_.nodes[cell + 1] - model_.nodes[cell]).slope.dot(values(cell));
}

double Solution::shear(double x) const {
  const int cell = place(model_.nodes, x).cell;
  double sum = sum_q_[cell] + force_between(model_.nodes[cell], x);
  for (const PointLoad& f : forces_)
    if (f.x <= x && (f.x < beam_.length)) sum += f.force;
  return -sum;
}

double Solution::moment(double x) const {
  const int cell = place(model_.nodes, x).cell;
  double sum = sum_moment_[cell] + (x - model_.nodes[cell]) * sum_q_[cell] + moment_between(model_.nodes[cell], x);
  for (const PointLoad& f : forces_)
    if (f.x <= x && f.x < beam_.length) sum += f.force * (x - f.x) - f.moment;
  return -sum;
}

double Solution::foundation_force(int node) const {
  const int row = model_.foundation.empty() ? -1 : model_.foundation[node];
  return row < 0 ? 0 : result_.state.lambda[row];
}

double Solution::pressure(double x) const {
  const auto [cell, s] = place(model_.nodes, x);
  const auto at = [&](int node) { return foundation_force(node) / model_.share(node); };
  return (1 - s) * at(cell) + s * at(cell + 1);
}

Reaction Solution::reaction(int support) const {
  const SupportRows& rows = model_.supports[support];
  const Support& laws = beam_.supports[support];
  const auto& [u, lambda] = result_.state;
  Reaction r;
  if (rows.deflection >= 0) r.force = lambda[rows.deflection];
  if (rows.rotation >= 0) r.moment = rows.turn * lambda[rows.rotation] * model_.unit;
  if (laws.deflection->load) r.force = laws.deflection.force();
  if (laws.rotation->load) r.moment = laws.rotation.force();
  r.deflection = u.here()[2 * rows.node];
  r.rotation = u.here()[2 * rows.node + 1] / model_.unit;
  return r;
}

}  // namespace dotyk::beam
