#include "solver/rows/uzawa.hpp"

#include "solver/rows/equilibrium.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;

void Uzawa::iterate(RowIteration& it) const {
  Equilibrium equilibrium(it);
  const double bound = equilibrium.step_bound(it.map.rho());
  const Vector step = rho * bound * it.map.rho();
  it.remark(text("rho = ", rho * bound, " for a bound 2/λ_max of ", bound, " (in units of 1/W_rr)",
                 rho >= 1 ? ", beyond which steps need not converge" : ""));
  solver::iterate(it, equilibrium, [&](const Vector& lambda, const Vector& x) {
    return project(it.problem, lambda + step.cwiseProduct(x), step);
  });
}

}  // namespace dotyk::solver
