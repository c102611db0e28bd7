// The methods on the condensed rows beside Newton's: uzawa, psor, projected_cg, proximal.
#include "script/bind/bind.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/rows/uzawa.hpp"
#include "solver/rows/uzawa_pdas.hpp"

namespace dotyk::script {
namespace {

/// Baselines take many cheap iterations.
constexpr int kMany = 20000;

/// What solves with given friction; its name and options.
std::string take_inner(solver::CoulombLoop& loop, Call& call) {
  loop.inner = std::make_shared<solver::Newton>();
  if (!call.has("inner")) return "inner = newton";
  const auto given = call.object<Solver>("inner");
  loop.inner = given->method.on_rows();
  if (!loop.inner)
    throw InputError(text("inner is ", given->text(), ", which does not work on contact rows alone with friction; ", solver::kRowMethods, " do"));
  return "inner = " + given->text();
}

}  // namespace

void bind_friction_methods(Library& library) {
  using solver::Proximal, solver::Psor, solver::Uzawa, solver::UzawaPdas;
  using Unit = UzawaPdas::Unit;
  add_method<Uzawa>(
      library,
      {.name = "dotyk.solver.uzawa",
       .help = "Uzawa's method: projected gradient steps on the multipliers, contact with given or Coulomb friction. The "
               "step is measured by the bound 2/λ_max, which is estimated (from above) and told in s.reason.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.uzawa{ rho = 0.9 }:solve(scene)"},
      {key::positive("rho", "length of the steps as a part of the bound 2/λ_max; from 1 on convergence is not certain").into(&Uzawa::rho)},
      kMany, [](const Uzawa& m, Call&) { return text("rho = ", m.rho); });
  add_method<UzawaPdas>(
      library,
      {.name = "dotyk.solver.uzawa_pdas",
       .help = "The alternating algorithm of TR965 2.1.3 and 3.1.3, as printed: contact by an active set step with "
               "friction frozen, then friction with contact frozen, with projected steps of length rho before each. "
               "It need not converge for rho beyond Uzawa's bound; s.reason tells a cycle from a stall. For Coulomb friction the bound "
               "is that of the normal forces at hand.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.uzawa_pdas{ rho = 1 }:solve(scene)"},
      {key::positive("rho", "length of the projected steps, and weight of the jumps where sets are chosen").into(&UzawaPdas::rho),
       key::choice<Unit>("unit", {{"bound", Unit::bound}, {"force/displacement", Unit::stiffness}, {"report", Unit::report}},
                          "of rho: Uzawa's bound 2/λ_max, as for uzawa; force per "
                          "displacement, the same on every row; or the report's, in which pressures and parts of the bound are the "
                          "multipliers: given friction").into(&UzawaPdas::unit)},
      1000, [](const UzawaPdas& m, Call&) {
        return text("rho = ", m.rho, m.unit == Unit::bound ? "" : m.unit == Unit::stiffness ? " force per displacement" : " in the report's units");
      }, true);
  add_method<Psor>(
      library,
      {.name = "dotyk.solver.psor",
       .help = "Projected over-relaxation, node by node: the normal force, then its friction, given or Coulomb.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.psor{ omega = 1.2 }:solve(scene)"},
      {key::number("omega", "relaxation, 1 for Gauss-Seidel").above(0).below(2).into(&Psor::omega)},
      kMany, [](const Psor& m, Call&) { return text("omega = ", m.omega); });
  add_method<solver::ProjectedCg>(
      library,
      {.name = "dotyk.solver.projected_cg",
       .help = "Projected conjugate gradients: contact with given friction, and Coulomb's by an outer loop over given "
               "friction.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.projected_cg{ tol = 1e-8 }:solve(scene)"},
      {},
      kMany, [](const solver::ProjectedCg&, Call&) { return ""; });
  add_method<Proximal>(
      library,
      {.name = "dotyk.solver.proximal",
       .help = "Newton's method with springs in the rows whose rest position follows the iterates and whose compliance "
               "goes to zero (the proximal point method): contact with given or Coulomb friction, also where there are more "
               "contact forces than motions, so that the forces are not unique (hyperstatic problems). An iteration takes one or "
               "several Newton steps; s.reason tells how many in all.",
       .setup = setup::contact_problem(),
       .example = "local r = dotyk.solver.proximal{ tol = 1e-12 }:solve(p)\nprint(r)"},
      {key::positive("sigma", "compliance of the springs at the start, as a part of that of the rows themselves").into(&Proximal::sigma)},
      100, [](const Proximal& m, Call&) { return text("sigma = ", m.sigma); });
  add_method<solver::CoulombLoop>(
      library,
      {.name = "dotyk.solver.coulomb_loop",
       .help = "Coulomb friction by the outer loop over given friction: bounds mu times the normal force of the last "
               "step, by any method that treats given friction. An iteration is a step of the loop; s.history[k].contraction "
               "is the change of the bounds against the change before, below 1 where the loop converges.",
       .setup = setup::pressed_block(", friction = dotyk.friction.coulomb(0.3)"),
       .example = "local s = dotyk.solver.coulomb_loop{ inner = dotyk.solver.projected_cg{} }:solve(scene)"},
      {{key::object<Solver>("inner", "what solves with given friction, made by one of dotyk.solver's").otherwise("dotyk.solver.newton{}")}},
      500, take_inner);
}

}  // namespace dotyk::script
