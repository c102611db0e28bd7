#pragma once

// A thermoelastic beam of moderate numbers and strong coupling: a₁ = 1, a₂α = 3, EJ ≈ 1, EF = 50.
#include "thermoelastic/stepping.hpp"

namespace dotyk::test {

inline Monitor monitor;  ///< never stops
namespace laws = problem::laws;

inline thermoelastic::Data thermal_beam(int cells = 16, double above = 0.2, double below = 0.2) {
  thermoelastic::Data d;
  d.length = 1;
  d.height = 0.5;
  d.E = 100;
  d.expansion = 0.1;
  d.conductivity = d.heat_capacity = 1;
  d.reference = 3;
  d.exchange_above = above;
  d.exchange_below = below;
  d.cells = cells;
  d.supports = {{"left", 0, {}, {}, {}}, {"right", 1, {}, {}, {}}};
  return d;
}

inline problem::LawChoice law(const problem::LawSpec* kind, double value = 0, double limit = 0) { return {kind, value, limit}; }

inline thermoelastic::Source source(std::function<double(double, double)> f) { return {0, std::move(f)}; }
inline thermoelastic::History history(std::function<double(double)> f) { return {0, std::move(f)}; }

}  // namespace dotyk::test
