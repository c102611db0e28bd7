#include "base/text.hpp"
#include "script/bridge/library.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "script/bind/methods/row_method.hpp"
#include "script/bind/setups.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"

namespace dotyk::script {
namespace {

int make_pdas(Call& call) {
  auto pdas = settings_of<solver::Pdas>(call);
  pdas.rho = call.number("rho");
  pdas.reduced = call.boolean("reduced");
  std::string shown = text("pdas: rho = ", pdas.rho, ", ", pdas.reduced ? "reduced" : "full");
  if (auto screws = screws_of(call, shown)) pdas.kernel = solver::Pdas::Kernel::screws, pdas.screws = std::move(*screws);
  return give_method(call, std::move(pdas), shown);
}

int make_newton(Call& call) {
  auto newton = settings_of<solver::Newton>(call);
  newton.rho = call.number("rho");
  newton.watch = call.boolean("watch");
  std::string shown = text("newton: rho = ", newton.rho, newton.watch ? ", watch" : "");
  if (call.has("seed")) {
    newton.seed = static_cast<unsigned>(call.integer("seed"));
    shown += text(", seed = ", *newton.seed);
  }
  return give_row_method(call, newton, shown);
}

}  // namespace

void bind_methods(Library& library) {
  library.function(
      {.name = "dotyk.solver.pdas",
       .help = "The primal-dual active set method, which is Newton's method on the contact conditions: "
               "finite, exact, usually a handful of iterations.",
       .setup = setup::pressed_block(),
       .example = "local s = dotyk.solver.pdas{ reduced = true }:solve(scene)",
       .arguments = {key::table(method_keys(
           with_kernel({key::positive("rho", "weight of the gap against the force when the first active set is chosen; "
                                 "multiplies each row's own stiffness").fallback(1.0),
            key::boolean("reduced", "iterate on the contact boundary alone, after one factorisation; else on the "
                                    "whole system, factored anew in each iteration").fallback(true)})))},
       .returns = "solver",
       .run = make_pdas});
  library.function(
      {.name = "dotyk.solver.newton",
       .help = "The generalised Newton method on normal and tangential part together: contact with given "
               "or Coulomb friction, in the plane and in space, on the contact boundary alone.",
       .setup = setup::pressed_block(),
       .example = "local s = dotyk.solver.newton{ tol = 1e-10 }:solve(scene)",
       .arguments = {key::table(method_keys(with_kernel(
           {key::positive("rho", "weight of slip and gap against force in the projections; multiplies the stiffness "
                                 "that each row sees").fallback(1.0),
            key::boolean("watch", "history[k].singular_value exactly; else estimated from the factors, right up to the "
                                  "root of the number of rows").fallback(false),
            key::integer("seed", "start at random multipliers, the same for the same seed: in a box from a tenth to a "
                                 "hundred times the size of those with everything stuck").within(0, 4294967295.0)
                .otherwise("start with all that touches stuck")})))},
       .returns = "solver",
       .run = make_newton});
  bind_friction_methods(library);
  bind_feti(library);
}

}  // namespace dotyk::script
