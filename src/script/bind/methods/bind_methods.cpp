#include "script/bind/bind.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "solver/active/pdas.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/programs/penalty.hpp"
#include "solver/rows/newton.hpp"

namespace dotyk::script {
namespace {

const char* reduced(bool is) { return is ? "reduced" : "full"; }

/// What solves the linear systems of pdas.
enum class Linear { factor, incomplete_factor, multigrid };

void take_linear(Linear linear, solver::Pdas& method) {
  method.reduced = false;
  if (linear == Linear::incomplete_factor) method.linear = solver::incomplete_factor();
  if (linear == Linear::multigrid) method.linear = solver::algebraic_multigrid();
}

const char* const kBoundary =
    "on the unknowns of the contact boundary, the stiffness condensed onto it once; else on all unknowns";

}  // namespace

void bind_methods(Library& library) {
  using solver::ActiveSet, solver::InteriorPoint, solver::Newton, solver::Pdas, solver::Penalty;
  add_method<Pdas>(
      library,
      {.name = "dotyk.solver.pdas",
       .help = "The primal-dual active set method, which is Newton's method on the contact conditions: "
               "finite, exact, usually a handful of iterations.",
       .example = "local s = dotyk.solver.pdas{ reduced = true }:solve(scene)"},
      {key::positive("rho", "weight of the gap against the force when the first active set is chosen; "
                              "multiplies each row's own stiffness").into(&Pdas::rho),
       key::boolean("reduced", "iterate on the contact boundary alone, after one factorisation; else on the "
                                "whole system, factored anew in each iteration").into(&Pdas::reduced),
       key::choice<Linear>("linear", {{"factor", Linear::factor}, {"incomplete_factor", Linear::incomplete_factor}, {"multigrid", Linear::multigrid}},
                           "in place of reduced: iterate on all unknowns, active rows held, and solve by a sparse factor, anew in each iteration, or by "
                           "conjugate gradients, which need little more memory than the matrix: with an incomplete factor, or with algebraic multigrid by PETSc, "
                           "whose iterations hardly grow with the mesh; with friction as well").otherwise("as reduced says")},
      100, [](Pdas& m, Call& call) {
        if (!call.has("linear")) return text("rho = ", m.rho, ", ", reduced(m.reduced));
        if (call.has("reduced")) throw InputError("'linear' is given beside 'reduced'; give one of them");
        take_linear(call.choice<Linear>("linear"), m);
        return text("rho = ", m.rho, ", linear = ", call.text("linear"));
      }, true);
  add_method<Newton>(
      library,
      {.name = "dotyk.solver.newton",
       .help = "The generalised Newton method on normal and tangential part together: contact with given "
               "or Coulomb friction, in the plane and in space, on the contact boundary alone.",
       .example = "local s = dotyk.solver.newton{ tol = 1e-10 }:solve(scene)"},
      {key::positive("rho", "weight of slip and gap against force in the projections; multiplies the stiffness "
                              "that each row sees").into(&Newton::rho),
       key::boolean("watch", "history[k].singular_value exactly; else estimated from the factors, right up to the "
                              "root of the number of rows").into(&Newton::watch),
       key::integer("seed", "start at random multipliers, the same for the same seed: in a box from a tenth to a "
                             "hundred times the size of those with everything stuck").within(0, 4294967295.0)
            .otherwise("start with all that touches stuck").into(&Newton::seed)},
      100, [](const Newton& m, Call&) {
        return text("rho = ", m.rho, m.watch ? ", watch" : "", m.seed ? text(", seed = ", *m.seed) : "");
      }, true);
  bind_friction_methods(library);
  bind_feti(library);
  add_method<ActiveSet>(
      library,
      {.name = "dotyk.solver.active_set",
       .help = "The active-set method for semidefinite quadratic programs (Netuka, ODAM 2001): frictionless contact of "
               "bodies held or free. Rows enter the working set as the bodies meet them and leave where they would pull. "
               "The solution's working_set counts rows added and dropped, singular KKT systems met and survived, "
               "factorisations, and times that zigzagging was noticed (repeats).",
       .example = "local s = dotyk.solver.active_set{ change = \"many\" }:solve(scene)\nprint(s.iterations, s.working_set.singular)"},
      {key::choice<ActiveSet::Change>("change", {{"one", ActiveSet::Change::one}, {"many", ActiveSet::Change::many}},
                                       "rows that enter or leave in a step").into(&ActiveSet::change),
       key::boolean("reduced", kBoundary).into(&ActiveSet::reduced)},
      20000, [](const ActiveSet& m, Call& call) {
        return "change = " + call.text("change") + ", " + reduced(m.reduced);
      });
  add_method<InteriorPoint>(
      library,
      {.name = "dotyk.solver.interior_point",
       .help = "Mehrotra's interior-point method on the quadratic program of frictionless contact. At its end every "
               "force and every gap is a little positive; nodes are closed where the force is the larger one, scaled.",
       .example = "local s = dotyk.solver.interior_point{ tol = 1e-10 }:solve(scene)"},
      {key::boolean("reduced", kBoundary).into(&InteriorPoint::reduced)},
      100, [](const InteriorPoint& m, Call&) { return reduced(m.reduced); });
  add_method<Penalty>(
      library,
      {.name = "dotyk.solver.penalty",
       .help = "The penalty method, never exact: springs between the bodies, factor times as stiff as the node itself. "
               "The bodies overlap, energy and force are off by O(1/factor). The solution's penalty says by how much: "
               "penetration (length), energy (force·length, what the energy is too low by); residual shows it as well. "
               "converged is said of the problem with springs.",
       .example = "local s = dotyk.solver.penalty{ factor = 1e3 }:solve(scene)\nprint(s.penalty.penetration, s.reason)"},
      {key::positive("factor", "stiffness of the springs over the stiffness that a contact node sees").into(&Penalty::factor),
       key::boolean("reduced", "forces as unknowns of their own, on the contact boundary: any factor; else the springs added to "
                                "the stiffness matrix, factored in each iteration: digits are lost as factor grows").into(&Penalty::reduced)},
      100, [](const Penalty& m, Call&) {
        return text("factor = ", m.factor, ", ", m.reduced ? "reduced" : "classical");
      });
}

}  // namespace dotyk::script
