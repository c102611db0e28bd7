// The methods on the condensed rows beside Newton's: uzawa, psor, projected_cg, proximal.
#include "base/text.hpp"
#include "script/library.hpp"
#include "script/method_keys.hpp"
#include "solver/projected_cg.hpp"
#include "solver/proximal.hpp"
#include "solver/psor.hpp"
#include "solver/uzawa.hpp"

namespace dotyk::script {
namespace {

/// Baselines take many cheap iterations.
constexpr int kMany = 20000;

int make_uzawa(Call& call) {
  solver::Uzawa uzawa;
  read_settings(call, uzawa);
  uzawa.rho = call.number("rho");
  return give_method(call, uzawa, text("uzawa: rho = ", uzawa.rho));
}

int make_psor(Call& call) {
  solver::Psor psor;
  read_settings(call, psor);
  psor.omega = call.number("omega");
  return give_method(call, psor, text("psor: omega = ", psor.omega));
}

int make_projected_cg(Call& call) {
  solver::ProjectedCg cg;
  read_settings(call, cg);
  return give_method(call, cg, "projected_cg");
}

int make_proximal(Call& call) {
  solver::Proximal proximal;
  read_settings(call, proximal);
  proximal.sigma = call.number("sigma");
  return give_method(call, proximal, text("proximal: sigma = ", proximal.sigma));
}

}  // namespace

void bind_friction_methods(Library& library) {
  library.function(
      {.name = "dotyk.solver.uzawa",
       .help = "Uzawa's method: projected gradient steps on the multipliers, contact with given or Coulomb friction. The "
               "step is measured by the bound 2/λ_max, which is estimated (from above) and told in s.reason.",
       .example = "local s = dotyk.solver.uzawa{ rho = 0.9 }:solve(scene)",
       .arguments = {key::table(method_keys(
           {key::positive("rho", "length of the steps as a part of the bound 2/λ_max; from 1 on convergence is not certain")
                .fallback(0.9)}, kMany))},
       .returns = "solver",
       .run = make_uzawa});
  library.function(
      {.name = "dotyk.solver.psor",
       .help = "Projected over-relaxation, node by node: the normal force, then its friction, given or Coulomb.",
       .example = "local s = dotyk.solver.psor{ omega = 1.2 }:solve(scene)",
       .arguments = {key::table(method_keys(
           {key::number("omega", "relaxation, 1 for Gauss-Seidel").above(0).within(0, 2).fallback(1.0)}, kMany))},
       .returns = "solver",
       .run = make_psor});
  library.function(
      {.name = "dotyk.solver.projected_cg",
       .help = "Projected conjugate gradients: contact with given friction, and Coulomb's by an outer loop over given "
               "friction.",
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
       .example = "local r = dotyk.solver.proximal{ tol = 1e-12 }:solve(dotyk.fclib \"stack.hdf5\")",
       .arguments = {key::table(method_keys(
           {key::positive("sigma", "compliance of the springs at the start, as a part of that of the rows themselves")
                .fallback(0.1)}))},
       .returns = "solver",
       .run = make_proximal});
}

}  // namespace dotyk::script
