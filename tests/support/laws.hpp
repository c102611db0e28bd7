#pragma once

#include "feti.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"

namespace dotyk::test {

using Laws = problem::LawChoice;
namespace laws = problem::laws;

inline void support(const std::shared_ptr<scene::Body>& b, const std::string& name, const Laws& normal, const Laws& tangential = {}) {
  auto p = part(b, name);
  scene::support(p, normal, tangential);
}

/// A method with as many iterations as slow convergence needs.
template <class Chosen>
solver::Method patient(Chosen method) {
  method.max_iterations = 20000;
  return method;
}

/// ‖u − v‖ / ‖v‖ over all unknowns.
inline double distance(const scene::Solution& a, const scene::Solution& b) {
  REQUIRE(a.result().converged);
  REQUIRE(b.result().converged);
  const auto &u = a.displacement(0), &v = b.displacement(0);
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < u.size(); ++k) difference += (u[k] - v[k]) * (u[k] - v[k]), size += v[k] * v[k];
  return std::sqrt(difference / size);
}

/// Nodal loads of a body, laws' loads not counted, and what the parts' supports exert: their sum.
inline double imbalance(const scene::Solution& s, const std::vector<std::string>& parts) {
  const auto body = s.scene().bodies.front();
  Point sum = resultant(*body);
  for (const std::string& name : parts) {
    const Point r = s.reaction(part(body, name));
    for (int i = 0; i < 3; ++i) sum[i] += r[i];
  }
  return std::hypot(sum[0], sum[1], sum[2]);
}

}  // namespace dotyk::test
