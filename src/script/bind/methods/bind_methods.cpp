// Methods: dotyk.solver.*.
#include <concepts>

#include "script/bind/bind.hpp"
#include "solver/active/pdas.hpp"
#include "solver/core/method.hpp"
#include "solver/feti/feti.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/programs/penalty.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/rows/uzawa.hpp"
#include "solver/rows/uzawa_pdas.hpp"
#include "solver/active/screws.hpp"

namespace dotyk::script {

std::string Solver::text() const { return own + dotyk::text(", tol = ", tol) + common; }

namespace {

using algebra::Ordering;

// Keys that every method takes; `own` come first.
std::vector<Key> method_keys(std::vector<Key> own, int max_iterations) {
  const std::vector<Key> common = {
      key::positive("tol", "relative natural residual at which iterative methods stop").into(&solver::Settings::tol),
      key::integer("max_iterations", "give up after so many").at_least(1).fallback(static_cast<double>(max_iterations)).into(&solver::Settings::max_iterations),
      key::choice<Ordering>("ordering", {{"automatic", Ordering::automatic}, {"minimum_degree", Ordering::minimum_degree},
                                         {"nested_dissection", Ordering::nested_dissection}},
                            "elimination order of the sparse factorisation").into(&solver::Settings::ordering),
      key::function("on_iteration", "called as f(k, info) after each iteration; returning false stops the solve"),
      key::boolean("verbose", "a line on standard error for each iteration").fallback(false)};
  return joined(std::move(own), common);
}

// `own`, and the keys kernel and screws: how rigid motions of free bodies are treated.
std::vector<Key> with_kernel(std::vector<Key> own) {
  return joined(std::move(own),
                {key::choice("kernel", {"exact", "screws"}, "rigid motions of free bodies: exactly, as constraints of the "
                            "dual problem, or by magnetic screws (contact nodes taken as closed, with given friction also as stuck; moved where they pull, "
                            "or bear more than friction can)").fallback("exact"),
                 key::list("screws", key::integer("", "").at_least(1), "rows (contact nodes, in order; then those of friction) where the screws "
                           "are placed first").otherwise("chosen by the load's equilibrium")});
}

// The rows where screws are placed first, from 0, empty where they are chosen; nothing where the kernel is exact. Added to `shown`.
std::optional<std::vector<int>> screws_of(const Call& call, std::string& shown) {
  if (call.text("kernel") == "exact") return {};
  shown += ", kernel by screws";
  std::vector<int> rows;
  if (call.has("screws"))
    for (const long long row : call.integers("screws")) rows.push_back(static_cast<int>(row - 1));
  for (std::size_t k = 0; k < rows.size(); ++k) shown += dotyk::text(k == 0 ? " first at rows " : ", ", rows[k] + 1);
  return rows;
}

// The solver object: `text` is its name and options as printed.
Given<Solver> give_method(Call& call, solver::Method method, std::string text) {
  std::string common = dotyk::text(", max_iterations = ", call.integer("max_iterations"));
  if (call.choice<Ordering>("ordering") != Ordering::automatic) common += ", ordering = " + call.text("ordering");
  auto made = std::make_shared<Solver>(
      Solver{std::move(method), "solver " + std::move(text), call.number("tol"), std::move(common), call.boolean("verbose")});
  return call.give_keeping(made, {"on_iteration"});
}

// The maker of a method: `own` are its keys, into its members, and own options are shown as show(method, call) says, which may set more
// of them. With `kernel`, magnetic screws may hold free bodies. Examples begin with setup::pressed_block(), unless `about` says otherwise.
template <class Method, class Show>
void add_method(Library& library, Descriptor about, std::vector<Key> own, int max_iterations, Show show, bool kernel = false) {
  about.arguments = {key::table(method_keys(kernel ? with_kernel(std::move(own)) : std::move(own), max_iterations))};
  if (about.setup.empty()) about.setup = setup::pressed_block();
  about.run = [name = about.short_name(), show, kernel](Call& call) {
    Method method;
    call.fill<solver::Settings>(method);
    call.fill(method);
    method.max_iterations = std::min(method.max_iterations, 1'000'000);
    const std::string options = show(method, call);
    std::string shown = name + (options.empty() ? "" : ": " + options);
    auto screws = kernel ? screws_of(call, shown) : std::nullopt;
    if constexpr (requires { method.kernel; }) {
      if (screws) method.kernel = Method::Kernel::screws, method.screws = std::move(*screws);
    } else if constexpr (std::derived_from<Method, solver::RowMethod>) {
      if (screws) {
        solver::WithScrews held(std::make_shared<const Method>(std::move(method)));
        held.screws = std::move(*screws);
        return give_method(call, std::move(held), std::move(shown));
      }
    }
    return give_method(call, std::move(method), std::move(shown));
  };
  library.function(std::move(about));
}

const char* reduced(bool is) { return is ? "reduced" : "full"; }

const char* const kBoundary =
    "on the unknowns of the contact boundary, the stiffness condensed onto it once; else on all unknowns";

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

constexpr int kMost = 1'000'000;

/// A member of the augmented Lagrangian's settings.
template <class Value>
auto outer(Value solver::Smalbe::*member) {
  return [member](solver::Feti& feti) -> Value& { return feti.outer.*member; };
}

void read_subdomains(const Call& call, problem::Decomposition& cut) {
  if (call.is("subdomains", LUA_TNUMBER)) {
    cut.count = static_cast<int>(call.integer("subdomains"));
  } else if (call.has("subdomains")) {
    const auto boxes = call.integers("subdomains");
    if (boxes.size() != 2 && boxes.size() != 3)
      throw InputError(text("subdomains has ", boxes.size(), boxes.size() == 1 ? " entry" : " entries", "; give a number, or two (in space three) numbers of boxes"));
    for (std::size_t k = 0; k < boxes.size(); ++k) cut.boxes[k] = static_cast<int>(boxes[k]);
  }
}

std::string show(const Call& call, const problem::Decomposition& cut) {
  if (!call.has("subdomains")) return "a subdomain a body";
  if (cut.count > 0) return text(cut.count, " subdomains");
  return text(cut.boxes[0], " × ", cut.boxes[1], " × ", cut.boxes[2], " boxes a body");
}

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

void bind_feti(Library& library) {
  using solver::Feti, solver::Smalbe;
  using Preconditioner = Feti::Preconditioner;
  using Stop = Feti::Stop;
  using Update = Smalbe::Update;
  using Expansion = solver::MprgpSettings::Expansion;
  add_method<Feti>(
      library,
      {.name = "dotyk.solver.feti",
       .help = "Domain decomposition for many bodies and for bodies beyond a direct method: every body is cut into "
               "subdomains, glued by multipliers, and the dual problem is solved by augmented Lagrangians with projectors to "
               "the natural coarse space of the subdomains' rigid motions. Frictionless contact, given friction, and "
               "Coulomb's by an outer loop. tol: on |projected gradient| / |P d| and on |G lambda - e| / |f|, rows "
               "scaled by the stiffness of what they join, and on what a subdomain's forces leave unbalanced. An iteration is an outer step; s.history[k].inner counts the steps of the inner method so far, "
               "s.feti tells what the decomposition was like.",
       .example = "local s = dotyk.solver.feti{ subdomains = 64, tol = 1e-8 }:solve(scene)\n"
                  "local t = dotyk.solver.feti{ subdomains = {4, 4, 4}, preconditioner = \"lumped\" }:solve(scene)"},
      {key::either("subdomains",
                   {key::integer("", "how many in all, shared out by cells and cut by METIS").within(1, kMost),
                    key::list("", key::integer("", "").within(1, 1000), "boxes along each axis of every body's bounding box; a third number counts in space only")},
                   "into what bodies are cut: a number in all, or boxes along the axes").otherwise("a subdomain a body"),
       key::choice<bool>("supports", {{"rows", true}, {"stiffness", false}}, "supports and springs as rows of the dual problem (total FETI: subdomains "
                   "of equal shape share a factor, and all have rigid motions for the coarse space), or in the subdomains' stiffness")
           .into<Feti>([](Feti& feti) -> bool& { return feti.decomposition.support_rows; }),
       key::choice<Preconditioner>("preconditioner", {{"none", Preconditioner::none}, {"lumped", Preconditioner::lumped}, {"dirichlet", Preconditioner::dirichlet}},
                                    "of the inner conjugate gradients; lumped is the paper's with coarse = \"whole\" alone").into(&Feti::preconditioner),
       key::choice<bool>("coarse", {{"face", true}, {"whole", false}}, "the coarse space in conjugate gradients: that of the multipliers free to "
                   "change, or only in the projectors (as the paper)").into(&Feti::face_coarse),
       key::choice<Update>("update", {{"precision", Update::precision}, {"penalty", Update::penalty}, {"both", Update::both}},
                            "of the augmented Lagrangian: of the inner precision M with rho "
                            "fixed (SMALBE-M), of rho with M fixed (the paper's algorithm 4.1), or whichever holds it up").into<Feti>(outer(&Smalbe::update)),
       key::positive("M", "an inner minimisation ends at |projected gradient| <= M |G lambda - e|; in units of |PFP|").into<Feti>(outer(&Smalbe::M)),
       key::positive("rho", "penalty of G lambda = e, at first; in units of |PFP|").below(1e10).into<Feti>(outer(&Smalbe::rho)),
       key::choice<Stop>("stop", {{"Pd", Stop::Pd}, {"d", Stop::d}}, "what tol compares the projected gradient with: |P d|, or |d| as the paper; that depends on the generalised "
                          "inverse, and then nothing is asked of what a subdomain's forces leave unbalanced but |G lambda - e|").into(&Feti::stop),
       key::positive("eta", "first bound of algorithm 4.1 on |G lambda - e|, beyond which rho grows, in units of |P d|/|PFP|; for other "
                      "updates on the projected gradient, in units of |P d|").into<Feti>(outer(&Smalbe::eta)),
       key::choice<Expansion>("expansion", {{"fixed_step", Expansion::fixed_step}, {"projected_cg", Expansion::projected_cg_step}},
                               "how the inner method lets multipliers reach their bounds: fixed projected steps (MPRGP), or projected "
                               "conjugate gradient steps (proportioning with projections)").into(&Feti::expansion),
       key::integer("max_inner", "give up after so many inner steps").at_least(1).into(&Feti::max_inner),
       key::boolean("spectrum", "estimate the condition of PFP on im P, in s.feti.condition").into(&Feti::spectrum)},
      1000, [](Feti& feti, Call& call) {
        read_subdomains(call, feti.decomposition);
        feti.max_inner = std::min(feti.max_inner, 100'000'000);
        return text(show(call, feti.decomposition), ", preconditioner = ", call.text("preconditioner"), ", M = ", feti.outer.M, ", rho = ", feti.outer.rho);
      });
}

}  // namespace

void bind_methods(Library& library) {
  using solver::ActiveSet, solver::InteriorPoint, solver::Levels, solver::Multigrid, solver::Newton, solver::Pdas, solver::Penalty;
  add_method<Pdas>(
      library,
      {.name = "dotyk.solver.pdas",
       .help = "The primal-dual active set method, which is Newton's method on the contact conditions: finite, exact, usually a handful of iterations.",
       .example = "local s = dotyk.solver.pdas{ reduced = true }:solve(scene)"},
      {key::positive("rho", "weight of the gap against the force when the first active set is chosen; multiplies each row's own stiffness").into(&Pdas::rho),
       key::boolean("reduced", "iterate on the contact boundary alone, after one factorisation; else on the whole system, factored anew in each iteration").into(&Pdas::reduced),
       key::choice<bool>("linear", {{"factor", false}, {"incomplete_factor", true}},
                           "in place of reduced: iterate on all unknowns, active rows held, and solve by a sparse factor, anew in each iteration, or by "
                           "conjugate gradients with an incomplete factor, which need little more memory than the matrix; with friction as well").otherwise("as reduced says")},
      100, [](Pdas& m, Call& call) {
        if (!call.has("linear")) return text("rho = ", m.rho, ", ", reduced(m.reduced));
        if (call.has("reduced")) throw InputError("'linear' is given beside 'reduced'; give one of them");
        m.reduced = false;
        if (call.choice<bool>("linear")) m.linear = solver::incomplete_factor();
        return text("rho = ", m.rho, ", linear = ", call.text("linear"));
      }, true);
  add_method<Multigrid>(
      library,
      {.name = "dotyk.solver.multigrid",
       .help = "The primal-dual active set method on all unknowns, with friction as well; linear systems by conjugate gradients with multigrid "
               "(PETSc), whose iterations hardly grow with the mesh. Levels are the coarser meshes of dotyk.mesh.rectangle and box with even numbers of cells, "
               "of mesh:refined and of second order; below a coarsest one of many unknowns, or where there are none, aggregates of unknowns. It treats piecewise linear laws only. "
               "Friction is refused at points whose unknowns another row has taken, as at corners.",
       .example = "local s = dotyk.solver.multigrid{}:solve(scene)\nprint(s.multigrid.levels, s.multigrid.cg, s.multigrid.newton)"},
      {key::choice<Levels>("levels", {{"meshes", Levels::meshes}, {"aggregates", Levels::aggregates}}, "what levels are made of").otherwise("meshes, where they are known"),
       key::boolean("nested", "begin at the solution on the next coarser mesh, found the same way and relaxed near the rows that bear; where that does not converge, once more "
                                "from rest").into<Multigrid>([](Multigrid& m) -> bool& { return m.nested; })},
      100, [](Multigrid& m, Call& call) {
        if (call.has("levels")) m.linear = solver::multigrid(call.choice<Levels>("levels"));
        return text(call.has("levels") ? "levels = " + call.text("levels") + ", " : "", "nested = ", m.nested ? "true" : "false");
      });
  add_method<Newton>(
      library,
      {.name = "dotyk.solver.newton",
       .help = "The generalised Newton method on normal and tangential part together: contact with given "
               "or Coulomb friction, in the plane and in space, on the contact boundary alone.",
       .example = "local s = dotyk.solver.newton{ tol = 1e-10 }:solve(scene)"},
      {key::positive("rho", "weight of slip and gap against force in the projections; multiplies the stiffness "
                              "that each row sees").into(&Newton::rho),
       key::boolean("watch", "true: history[k].singular_value is exact; false: an estimate from the factors, off by at most "
                              "the square root of the number of rows").into(&Newton::watch),
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
      100, [](const Penalty& m, Call&) { return text("factor = ", m.factor, ", ", m.reduced ? "reduced" : "classical"); });
}

}  // namespace dotyk::script
