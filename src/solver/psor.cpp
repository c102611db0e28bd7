#include "solver/psor.hpp"

#include "base/text.hpp"
#include "solver/equilibrium.hpp"
#include "solver/relaxation.hpp"

namespace dotyk::solver {

using algebra::Vector;

void Psor::iterate(RowIteration& it) const {
  Equilibrium equilibrium(it.condensed, it.alpha());
  const Relaxation relaxation(it.problem, equilibrium.W());
  it.move_to(it.lambda(), equilibrium.alpha(it.lambda()));
  while (it.next()) {
    Vector lambda = it.lambda(), x = it.jump();
    relaxation.sweep(omega, lambda, x);
    Vector alpha = equilibrium.alpha(lambda);
    it.move_to(std::move(lambda), std::move(alpha));
    if (it.record()) break;
    if (equilibrium.settle(it.law_residual(), it.lambda()))
      it.move_to(it.lambda(), equilibrium.alpha(it.lambda()));
    if (it.stalled()) break;
  }
}

}  // namespace dotyk::solver
