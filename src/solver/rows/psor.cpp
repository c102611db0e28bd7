#include "solver/rows/psor.hpp"

#include "solver/rows/relaxation.hpp"
#include "solver/rows/stationary_iteration.hpp"

namespace dotyk::solver {

using algebra::Vector;

void Psor::iterate(RowIteration& it) const {
  Equilibrium equilibrium = equilibrium_of(it);
  const Relaxation relaxation(it.problem, equilibrium.W());
  solver::iterate(it, equilibrium, [&](Vector lambda, Vector x) {
    relaxation.sweep(omega, lambda, x);
    return lambda;
  });
}

}  // namespace dotyk::solver
