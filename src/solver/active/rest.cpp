#include "solver/active/rest.hpp"

#include <cmath>

namespace dotyk::solver {

using algebra::Vector;

std::optional<Linearisation> held_at_rest(const problem::Problem& problem, const Linearisation& closed, const Vector& lambda,
                                          const Vector& rho, const Noise& noise) {
  std::optional<Linearisation> rest;
  for (const problem::RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      if (!closed.active[r] || std::abs(lambda[r]) > noise.force[r] || !(problem.c[r] > noise.gap[r])) continue;
      if (!rest) rest = closed;
      rest->y[r] = rest->value[r] - rho[r] * problem.c[r];
    }
  }
  return rest;
}

bool obeys(const Linearisation& found, const Linearisation& rest, const Linearisation& closed, const Vector& lambda, const Noise& noise) {
  for (int r = 0; r < static_cast<int>(closed.active.size()); ++r) {
    const bool held = rest.y[r] != closed.y[r];
    if (held ? std::abs(lambda[r]) > noise.force[r] : !found.same_piece(closed, r)) return false;
  }
  return true;
}

}  // namespace dotyk::solver
