#include "solver/rows/stationary_iteration.hpp"

namespace dotyk::solver {

using algebra::Vector;

Equilibrium equilibrium_of(const RowIteration& it, double weight) {
  Equilibrium equilibrium(it.condensed, it.alpha(), weight);
  if (it.begun()) equilibrium.go_on_from(it.lambda(), it.alpha());
  return equilibrium;
}

void move_to(RowIteration& it, const Equilibrium& equilibrium, Vector lambda) {
  Vector alpha = equilibrium.alpha(lambda);
  it.move_to(std::move(lambda), std::move(alpha));
}

void iterate(RowIteration& it, Equilibrium& equilibrium, const std::function<Vector(Vector, Vector)>& next) {
  move_to(it, equilibrium, it.lambda());
  while (it.next()) {
    move_to(it, equilibrium, next(it.lambda(), it.jump()));
    if (it.record()) break;
    if (equilibrium.settle(it.law_residual(), it.lambda())) move_to(it, equilibrium, it.lambda());
    if (it.stalled()) break;
  }
}

}  // namespace dotyk::solver
