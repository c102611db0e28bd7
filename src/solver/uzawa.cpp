#include "solver/uzawa.hpp"

#include "base/text.hpp"
#include "solver/equilibrium.hpp"
#include "solver/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;

void Uzawa::iterate(RowIteration& it) const {
  Equilibrium equilibrium(it.condensed, it.alpha());
  const double bound = equilibrium.step_bound(it.map.rho());
  const Vector step = rho * bound * it.map.rho();
  it.remark(text("rho = ", rho * bound, " for a bound 2/λ_max of ", bound, " (in units of 1/W_rr)",
                 rho >= 1 ? ", beyond which steps need not converge" : ""));
  it.move_to(it.lambda(), equilibrium.alpha(it.lambda()));
  while (it.next()) {
    Vector lambda = project(it.problem, it.lambda() + step.cwiseProduct(it.jump()), step);
    Vector alpha = equilibrium.alpha(lambda);
    it.move_to(std::move(lambda), std::move(alpha));
    if (it.record()) break;
    if (equilibrium.settle(it.law_residual(), it.lambda()))
      it.move_to(it.lambda(), equilibrium.alpha(it.lambda()));
    if (it.stalled()) break;
  }
}

}  // namespace dotyk::solver
