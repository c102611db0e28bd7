#include "base/text.hpp"
#include "script/bridge/library.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "script/bind/setups.hpp"
#include "solver/programs/active_set.hpp"
#include "solver/programs/interior_point.hpp"
#include "solver/programs/penalty.hpp"

namespace dotyk::script {
namespace {

Key reduced_key(const char* help) { return key::boolean("reduced", help).fallback(true); }

const char* const kBoundary =
    "on the unknowns of the contact boundary, the stiffness condensed onto it once; else on all unknowns";

int make_active_set(Call& call) {
  auto method = settings_of<solver::ActiveSet>(call);
  method.change = call.choice("change") == 0 ? solver::ActiveSet::Change::one : solver::ActiveSet::Change::many;
  method.reduced = call.boolean("reduced");
  const bool one = method.change == solver::ActiveSet::Change::one;
  return give_method(call, method, text("active_set: change = ", one ? "one" : "many", ", ", method.reduced ? "reduced" : "full"));
}

int make_interior_point(Call& call) {
  auto method = settings_of<solver::InteriorPoint>(call);
  method.reduced = call.boolean("reduced");
  return give_method(call, method, text("interior_point: ", method.reduced ? "reduced" : "full"));
}

int make_penalty(Call& call) {
  auto method = settings_of<solver::Penalty>(call);
  method.factor = call.number("factor");
  method.reduced = call.boolean("reduced");
  return give_method(call, method, text("penalty: factor = ", method.factor, ", ", method.reduced ? "reduced" : "classical"));
}

}  // namespace

void bind_program_methods(Library& library) {
  library.function(
      {.name = "dotyk.solver.active_set",
       .help = "The active-set method for semidefinite quadratic programs (Netuka, ODAM 2001): frictionless contact of "
               "bodies held or free. Rows enter the working set as the bodies meet them and leave where they would pull. "
               "The solution's working_set counts rows added and dropped, singular KKT systems met and survived, "
               "factorisations, and times that zigzagging was noticed (repeats).",
       .setup = setup::pressed_block(),
       .example = "local s = dotyk.solver.active_set{ change = \"many\" }:solve(scene)\nprint(s.iterations, s.working_set.singular)",
       .arguments = {key::table(method_keys({key::choice("change", {"one", "many"}, "rows that enter or leave in a step")
                                                 .fallback("one"),
                                             reduced_key(kBoundary)},
                                            20000))},
       .returns = "solver",
       .run = make_active_set});
  library.function(
      {.name = "dotyk.solver.interior_point",
       .help = "Mehrotra's interior-point method on the quadratic program of frictionless contact. At its end every "
               "force and every gap is a little positive; nodes are closed where the force is the larger one, scaled.",
       .setup = setup::pressed_block(),
       .example = "local s = dotyk.solver.interior_point{ tol = 1e-10 }:solve(scene)",
       .arguments = {key::table(method_keys({reduced_key(kBoundary)}))},
       .returns = "solver",
       .run = make_interior_point});
  library.function(
      {.name = "dotyk.solver.penalty",
       .help = "The penalty method, never exact: springs between the bodies, factor times as stiff as the node itself. "
               "The bodies overlap, energy and force are off by O(1/factor). The solution's penalty says by how much: "
               "penetration (length), energy (force·length, what the energy is too low by); residual shows it as well. "
               "converged is said of the problem with springs.",
       .setup = setup::pressed_block(),
       .example = "local s = dotyk.solver.penalty{ factor = 1e3 }:solve(scene)\nprint(s.penalty.penetration, s.reason)",
       .arguments = {key::table(method_keys(
           {key::positive("factor", "stiffness of the springs over the stiffness that a contact node sees").fallback(1000.0),
            reduced_key("forces as unknowns of their own, on the contact boundary: any factor; else the springs added to "
                        "the stiffness matrix, factored in each iteration: digits are lost as factor grows")}))},
       .returns = "solver",
       .run = make_penalty});
}

}  // namespace dotyk::script
