#pragma once

#include <algorithm>
#include <cmath>

#include "plates.hpp"

namespace dotyk::test {

/// How far (v, r) is from the law's graph, r per length in units of `force`, v of `displacement`: the lesser way where a spring is stiff.
inline double off_law(const LawChoice& law, double v, double r, double displacement, double force) {
  const double spring = law.is(laws::friction) || law.is(laws::one_sided_friction) || law.is(laws::load) ? 0 : std::max(law.numbers[0], law.numbers[1]);
  const auto force_off = [&](double expected) { return std::abs(r - expected) / (force + spring * displacement); };
  const double rigid = std::abs(v) / displacement;
  const double first = law.numbers[0], second = law.numbers[1];
  if (law.is(laws::free)) return force_off(0);
  if (law.is(laws::prescribed)) return std::abs(v - first) / displacement;
  if (law.is(laws::load)) return force_off(first);
  if (law.is(laws::elastic)) return force_off(-first * v);
  if (law.is(laws::one_sided_elastic)) return force_off(first * std::max(-v, 0.0));
  if (law.is(laws::unequal_elastic)) return force_off(-(v < 0 ? first : second) * v);
  if (law.is(laws::capped_elastic)) return force_off(std::clamp(-first * v, -second, second));
  if (law.is(laws::signorini)) return std::max({-v / displacement, -r / force, std::min(rigid, std::abs(r) / force)});
  if (law.is(laws::friction)) return std::min(std::max(rigid, (std::abs(r) - first) / force), force_off(v > 0 ? -first : first));
  if (law.is(laws::one_sided_friction)) return std::min(std::max({rigid, (r - first) / force, -r / force}), force_off(v > 0 ? 0 : first));
  if (law.is(laws::compliance)) return force_off(first * std::pow(std::max(-v, 0.0), second));
  return INFINITY;
}

/// The greatest of off_law() at the points of edges where laws act by rows, displacements of deflections and slopes together, and
/// of point supports; corners with several rows are left out where their laws are of different kinds, as only one of them may prevail.
/// `t`: how far along the family of all solutions, where there is one.
inline double off_laws(const plate::Solution& s, double t = 0) {
  const plate::Model& m = s.model();
  algebra::Vector u = s.freedoms();
  if (t != 0) u += t * s.family().value().motion;
  const auto value = [&](const plate::Functional& f) {
    double sum = 0;
    for (const plate::Term& term : f) sum += term.factor * u[term.freedom];
    return sum;
  };
  const algebra::Vector& lambda = s.result().state.lambda;
  double length = m.space.unit, greatest = 0, most = u.lpNorm<Eigen::Infinity>();
  for (const auto* samples : {&m.deflections, &m.rotations})
    for (const plate::Sample& a : *samples)
      if (a.row >= 0) greatest = std::max(greatest, std::abs(lambda[a.row]) / a.share);
  for (const int row : m.point_row)
    if (row >= 0) greatest = std::max(greatest, std::abs(lambda[row]) / length);
  greatest = std::max({greatest, m.D.front() * most / (length * length * length), 1e-300});  // a plate that nothing bends is moved by rounding
  double worst = 0;
  for (const plate::Sample& a : m.deflections)
    if (a.row >= 0) worst = std::max(worst, off_law(a.law, value(plate::deflection(m.space, a)), lambda[a.row] * a.part_of_row / a.share, most, greatest));
  for (const plate::Sample& a : m.rotations) {
    if (a.row < 0) continue;
    const double turn = a.law->directed() ? -1 : 1;  // one-sided ones keep the slope down
    const double v = turn * value(plate::rotation(m.space, a)), r = lambda[a.row] * a.part_of_row / a.share * m.space.unit;
    worst = std::max(worst, off_law(a.law, v, r, most / length, greatest * length));
  }
  for (std::size_t k = 0; k < m.point_row.size(); ++k) {
    if (m.point_row[k] < 0) continue;
    const auto& p = s.plate().supports[k];
    worst = std::max(worst, off_law(p.deflection, s.deflection(p.x, p.y) + t * s.motion(p.x, p.y), lambda[m.point_row[k]], most, greatest * length));
  }
  return worst;
}

}  // namespace dotyk::test
