// The methods on the condensed rows beside Newton's: uzawa, psor, projected_cg, proximal.
#include "base/text.hpp"
#include "script/bridge/library.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "script/bind/methods/row_method.hpp"
#include "script/bind/setups.hpp"
#include "script/bridge/wrapped.hpp"
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

int make_uzawa(Call& call) {
  auto uzawa = settings_of<solver::Uzawa>(call);
  uzawa.rho = call.number("rho");
  return give_method(call, uzawa, text("uzawa: rho = ", uzawa.rho));
}

int make_uzawa_pdas(Call& call) {
  auto method = settings_of<solver::UzawaPdas>(call);
  method.rho = call.number("rho");
  using Unit = solver::UzawaPdas::Unit;
  method.unit = static_cast<Unit>(call.choice("unit"));
  return give_row_method(call, method,
                         text("uzawa_pdas: rho = ", method.rho, method.unit == Unit::bound ? "" : method.unit == Unit::stiffness ? " force per displacement" : " in the report's units"));
}

int make_psor(Call& call) {
  auto psor = settings_of<solver::Psor>(call);
  psor.omega = call.number("omega");
  return give_method(call, psor, text("psor: omega = ", psor.omega));
}

int make_projected_cg(Call& call) {
  auto cg = settings_of<solver::ProjectedCg>(call);
  return give_method(call, cg, "projected_cg");
}

int make_proximal(Call& call) {
  auto proximal = settings_of<solver::Proximal>(call);
  proximal.sigma = call.number("sigma");
  return give_method(call, proximal, text("proximal: sigma = ", proximal.sigma));
}

int make_coulomb_loop(Call& call) {
  auto loop = settings_of<solver::CoulombLoop>(call);
  loop.inner = std::make_shared<solver::Newton>();
  std::string inner = "newton";
  if (call.has("inner")) {
    const auto given = call.object<Solver>("inner");
    loop.inner = given->method.on_rows();
    inner = given->text();
    if (!loop.inner)
      throw InputError(text("inner is ", inner, ", which does not work on contact rows alone with friction; ", solver::kRowMethods, " do"));
  }
  return give_method(call, loop, text("coulomb_loop: inner = ", inner));
}

}  // namespace

void bind_friction_methods(Library& library) {
  library.function(
      {.name = "dotyk.solver.uzawa",
       .help = "Uzawa's method: projected gradient steps on the multipliers, contact with given or Coulomb friction. The "
               "step is measured by the bound 2/λ_max, which is estimated (from above) and told in s.reason.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.uzawa{ rho = 0.9 }:solve(scene)",
       .arguments = {key::table(method_keys(
           {key::positive("rho", "length of the steps as a part of the bound 2/λ_max; from 1 on convergence is not certain")
                .fallback(0.9)}, kMany))},
       .returns = "solver",
       .run = make_uzawa});
  library.function(
      {.name = "dotyk.solver.uzawa_pdas",
       .help = "The alternating algorithm of TR965 2.1.3 and 3.1.3, as printed: contact by an active set step with "
               "friction frozen, then friction with contact frozen, with projected steps of length rho before each. "
               "It need not converge for rho beyond Uzawa's bound; s.reason tells a cycle from a stall. For Coulomb friction the bound "
               "is that of the normal forces at hand.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.uzawa_pdas{ rho = 1 }:solve(scene)",
       .arguments = {key::table(method_keys(
           with_kernel({key::positive("rho", "length of the projected steps, and weight of the jumps where sets are chosen").fallback(0.5),
                        key::choice("unit", {"bound", "force/displacement", "report"}, "of rho: Uzawa's bound 2/λ_max, as for uzawa; force per "
                                    "displacement, the same on every row; or the report's, in which pressures and parts of the bound are the "
                                    "multipliers: given friction").fallback("bound")}), 1000))},
       .returns = "solver",
       .run = make_uzawa_pdas});
  library.function(
      {.name = "dotyk.solver.psor",
       .help = "Projected over-relaxation, node by node: the normal force, then its friction, given or Coulomb.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.psor{ omega = 1.2 }:solve(scene)",
       .arguments = {key::table(method_keys(
           {key::number("omega", "relaxation, 1 for Gauss-Seidel").above(0).below(2).fallback(1.0)}, kMany))},
       .returns = "solver",
       .run = make_psor});
  library.function(
      {.name = "dotyk.solver.projected_cg",
       .help = "Projected conjugate gradients: contact with given friction, and Coulomb's by an outer loop over given "
               "friction.",
       .setup = setup::pressed_block(", friction = dotyk.friction.tresca(2)"),
       .example = "local s = dotyk.solver.projected_cg{ tol = 1e-8 }:solve(scene)",
       .arguments = {key::table(method_keys({}, kMany))},
       .returns = "solver",
       .run = make_projected_cg});
  library.function(
      {.name = "dotyk.solver.proximal",
       .help = "Newton's method with springs in the rows whose rest position follows the iterates and whose compliance "
               "goes to zero (the proximal point method): contact with given or Coulomb friction, also where there are more "
               "contact forces than motions, so that the forces are not unique (hyperstatic problems). An iteration takes one or "
               "several Newton steps; s.reason tells how many in all.",
       .setup = setup::contact_problem(),
       .example = "local r = dotyk.solver.proximal{ tol = 1e-12 }:solve(p)\nprint(r)",
       .arguments = {key::table(method_keys(
           {key::positive("sigma", "compliance of the springs at the start, as a part of that of the rows themselves")
                .fallback(0.1)}))},
       .returns = "solver",
       .run = make_proximal});
  library.function(
      {.name = "dotyk.solver.coulomb_loop",
       .help = "Coulomb friction by the outer loop over given friction: bounds mu times the normal force of the last "
               "step, by any method that treats given friction. An iteration is a step of the loop; s.history[k].contraction "
               "is the change of the bounds against the change before, below 1 where the loop converges.",
       .setup = setup::pressed_block(", friction = dotyk.friction.coulomb(0.3)"),
       .example = "local s = dotyk.solver.coulomb_loop{ inner = dotyk.solver.projected_cg{} }:solve(scene)",
       .arguments = {key::table(method_keys(
           {key::object<Solver>("inner", "what solves with given friction, made by one of dotyk.solver's")
                .otherwise("dotyk.solver.newton{}")}, 500))},
       .returns = "solver",
       .run = make_coulomb_loop});
}

}  // namespace dotyk::script
