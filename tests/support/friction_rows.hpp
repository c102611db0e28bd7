#pragma once

#include "problem/problem.hpp"

namespace dotyk::test {

/// Contact points 0 … points − 1 with their normal rows first, then the tangential rows point by point, all
/// under one friction law; rows alone, without bodies.
inline problem::Problem friction_rows(int points, int components, bool coulomb, double friction) {
  problem::Problem p;
  p.c = algebra::Vector::Zero(points * (1 + components));
  p.groups.push_back({"contact", problem::unilateral(), 0, points});
  problem::FrictionGroup group;
  group.name = coulomb ? "Coulomb friction" : "given friction";
  const std::vector<double> values(points, friction);
  group.law = coulomb ? problem::coulomb(values) : problem::tresca(values);
  group.first = points;
  group.components = components;
  for (int k = 0; k < points; ++k) group.normal.push_back(k);
  p.friction.push_back(std::move(group));
  return p;
}

}  // namespace dotyk::test
