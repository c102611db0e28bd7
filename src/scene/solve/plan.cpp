#include <algorithm>
#include <cmath>

#include "algebra/direct/stop_factoring.hpp"
#include "base/listed.hpp"
#include "base/memory.hpp"
#include "elasticity/rigid_modes.hpp"
#include "problem/uniqueness.hpp"
#include "scene/solve/doubts.hpp"
#include "scene/model/model.hpp"
#include "scene/statement/scene.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/near_rows.hpp"
#include "solver/core/turned_nodes.hpp"
#include "solver/core/require_solvable.hpp"

namespace dotyk::scene {
namespace {

std::string describe_body(const Body& body) {
  return text("  '", body.name, "': ", body.mesh->topology().name, " ", body.mesh->topology().shapes, ", ",
              body.node_count(), " nodes, ", body.cell_count(), " cells",
              body.unrefined ? ", refined by the ranks" : "");
}

bool no_slip(const Contact& contact) {
  for (std::size_t k = 0; k < contact.rows.size(); ++k)
    if (std::isfinite(contact.tangential[k].bound())) return false;
  return true;
}

std::string describe_contact(const Contact& contact) {
  static const char* pairing[] = {" node pairs", " nodes, node to segment", " nodes, mortar"};
  static const char* how[] = {"", ", node to segment", ", mortar"};
  if (contact.kind == Contact::Kind::glue)
    return text("  ", contact.name, ": ", contact.glued.size(), pairing[static_cast<int>(contact.pairing)]);
  const char* multipliers =
      contact.discretisation.multipliers == contact::Multipliers::p1_p0 ? ", multipliers P1-P0" : "";
  const std::string normal = contact.normal->stop() ? "" : "normal " + problem::describe(contact.normal) + ", ";
  return text("  ", contact.name, ": ", contact.rows.size(), " rows, ", normal,
              !contact.tangential->acts()   ? "frictionless"
              : contact.tangential->follows ? "Coulomb friction"
              : contact.tangential->rubs()  ? no_slip(contact) ? "no slip" : "given friction"
                                            : "tangential " + problem::describe(contact.tangential),
              how[static_cast<int>(contact.pairing)], multipliers);
}

/// Work and memory of condensed rows where they are worth a word. Kernels reach some 20 Gflop/s a core.
std::string condensing(const problem::Problem& problem, const solver::Choice& choice) {
  constexpr double kLeast = 2e9, kRate = 2e10, kMuch = 0.5;
  if (!choice.factors_fit) return "";
  const std::optional<solver::NearRows> near = choice.near.empty() ? std::nullopt : std::optional<solver::NearRows>({problem, choice.near, {}});
  const problem::CondensingWork work = problem::work_of_condensing(near ? near->restricted() : problem);
  if (work.flops < kLeast) return "";
  std::string out = text("; ", near ? text("first on the ", near->count(), " rows that overlap, ") : "", "some ", std::ceil(work.flops * 1e-9), " Gflop, ",
                         std::ceil(work.flops / kRate), " s on a core, and ", std::ceil(work.bytes * 1e-6), " MB");
  if (problem::dense_bytes(near ? near->count() : problem.rows()) > kMuch * work.bytes)
    out += "; warning: most of it is the dense matrices of the rows; feti forms none";
  return out;
}

/// The method that solves it where none is named, and why.
std::string method(const problem::Problem& problem, const solver::Choice& choice, bool any_free) {
  using By = solver::Choice::By;
  if (choice.turned) {
    const solver::TurnedNodes nodes(problem);
    const problem::Problem turned = nodes.turned();
    return method(turned, solver::by_factors(turned), any_free) + choice.costs +
           text("; ", problem.rows() - nodes.count(), " rows of oblique slides are none, since their nodes' frames are turned");
  }
  const auto factored = [&] { return text(" (", problem.unknowns(), " unknowns factored once", condensing(problem, choice), choice.costs, ")"); };
  if (choice.by == By::linear) return text("one linear solve of ", problem.unknowns(), " unknowns");
  if (choice.by == By::multigrid) return text("multigrid on all ", problem.unknowns(), " unknowns", choice.costs);
  if (choice.by == By::newton) return "newton on the condensed rows of contact and friction" + factored();
  if (choice.by == By::held)
    return text("pdas on all ", problem.unknowns(), " unknowns, one sparse factorisation an iteration (reduced = false): its ", problem.rows(),
                " rows need not be condensed, or are too many");
  return text("pdas on ", problem.rows(), " condensed rows", factored(), ": finite and exact for frictionless contact",
              any_free ? "; rigid motions exactly, as constraints of the dual (to compare: magnetic screws, pdas{ kernel = \"screws\" })" : "");
}

std::string with_coulomb(const problem::Uniqueness& theory) {
  if (!theory.exists)
    return std::string("whether there is a solution, and only one, is unknown before solving: forces within the cones of friction balance "
                       "the load, but how great the pressure can be ") +
           (theory.held ? "is not bounded where rows depend on each other" : "depends on the deformation of bodies that nothing else holds");
  return theory.held ? "a solution exists; whether it is unique is unknown before solving: it is for small coefficients of friction "
                       "(scene:uniqueness() computes how small)"
                     : "a solution exists; whether it is unique is unknown before solving: bodies are free and friction is Coulomb's";
}

/// What is known of a scene's solutions before they are computed. Throws InputError where there is none, as solver::require_solvable.
struct KnownBefore {
  problem::Uniqueness theory;
  std::string text;  ///< one sentence: unique; unique stress, displacement up to a motion; or unknown before solving
};

KnownBefore known_before(const problem::Problem& problem, const problem::RigidMotions& rigid) {
  const auto [note, exists] = solver::require_solvable(problem, rigid);
  KnownBefore known{problem::uniqueness(rigid, problem), ""};
  problem::Uniqueness& theory = known.theory;
  if (!theory.coulomb) theory.exists = exists, theory.unique = theory.unique && exists && note.empty();
  if (!exists && !(theory.coulomb && theory.exists))
    known.text = "whether there is a solution, and only one, is unknown before solving: neither forces that balance the load were found nor a "
                 "motion that nothing stops";
  else if (theory.coulomb)
    known.text = with_coulomb(theory) + (note.empty() ? "" : "; " + note);
  else if (!note.empty())
    known.text = "a solution exists with unique stress, " + note;
  else if (theory.unique)
    known.text = rigid.count() == 0 ? "a unique solution exists: every body is held by its supports"
                 : theory.held      ? "a unique solution exists: supports and contacts hold every body"
                                    : "a unique solution exists: the load presses every free body against what holds it";
  else if (theory.motion.size() > 0)
    known.text = "a solution exists with unique stress, displacement up to " + describe(rigid.motions, theory.motion) +
                 ": what holds it may do so in a range of places";
  else
    known.text = "a solution exists with unique stress; whether its displacement is unique is unknown before solving: it is, unless "
                 "the contacts that hold leave a motion free, which the solution then names";
  return known;
}

/// Whether the load can be carried, and by supports worth the name.
std::string verdict(const Scene& scene, const Model& model) {
  std::string warnings;
  for (const std::string& body : describe_nearly_free(scene, model)) warnings += "\n  warning: " + body;
  return known_before(model.problem, problem::rigid_motions(model.problem)).text + warnings;
}

/// Two lines; everything is assembled for them.
std::string method_and_verdict(const Scene& scene, bool any_free) {
  problem::Clock clock;
  Monitor quiet;
  std::string out = "\n  method: ", how = "none, since there is no solution";
  const bool by_ranks = scene.bodies.front()->unrefined != nullptr;
  try {
    const Model model = build(scene, clock, quiet, {}, {}, [&](const problem::Problem&) { return by_ranks; });
    how = by_ranks ? text("multigrid on all ", model.problem.all_unknowns(), " unknowns, by the ranks that refine the bodies") : method(model.problem, solver::choose(model.problem, memory_limit()), any_free);
    return out + how + "\n  " + verdict(scene, model);
  } catch (const InputError& error) {
    return out + (by_ranks ? "none on several ranks: " : how + "\n  no solution: ") + error.what();
  }
}

}  // namespace

std::string describe(const Scene& scene) {
  std::string out = text("scene: ", scene.dimension(), "-D, ", scene.bodies.size(),
                         scene.bodies.size() == 1 ? " body, " : " bodies, ", scene.contacts.size(),
                         scene.contacts.size() == 1 ? " contact" : " contacts");
  for (const auto& body : scene.bodies) out += "\n" + describe_body(*body);
  for (const auto& contact : scene.contacts) out += "\n" + describe_contact(*contact);
  return out;
}

std::string plan(const Scene& scene) {
  std::string out = "plan: linear elasticity at rest, for small strains and rotations (a few per cent), contact of what faces each other before the load";
  int free = 0;
  for (const auto& body : scene.bodies) {
    const auto numbering = number(*body);
    const auto rigid = elasticity::rigid_modes(*body->mesh, numbering, body->facet_springs());
    free += static_cast<int>(rigid.motions.size());
    out += "\n" + describe_body(*body) + text(", ", numbering.count() + body->hidden_components(), " unknowns");
    out += rigid.motions.empty() ? "; held by its supports" : body->laws.empty() ? "; free to move but for contact: "
                                   : "; free to move but for contact and laws of supports: ";
    out += listed(texts(rigid.motions));
    for (const LawSupport& on : body->laws) out += text("\n    on ", on.part.name, " (", on.nodes.size(), " nodes): ", describe(on));
  }
  for (const auto& contact : scene.contacts) out += "\n" + describe_contact(*contact);
  return out + method_and_verdict(scene, free > 0) + describe(doubts(scene));
}

UniquenessOfScene uniqueness(const Scene& scene, Monitor& monitor) {
  problem::Clock clock;
  const Model model = build(scene, clock, monitor);
  const algebra::StopFactoring stop(monitor);
  const problem::RigidMotions rigid = problem::rigid_motions(model.problem);
  const KnownBefore known = known_before(model.problem, rigid);
  UniquenessOfScene out{known.theory.exists, known.theory.unique, std::nullopt, known.text};
  if (!known.theory.coulomb || rigid.count() > 0 || !known.theory.exists) return out;
  const problem::CondensedProblem condensed(model.problem, rigid, algebra::Ordering::automatic, clock, monitor);
  out.factor = problem::uniqueness_factor(model.problem, condensed);
  if (!out.factor) return out;
  out.unique = *out.factor > 1;
  out.text = text("a solution exists; it is proved to be unique for coefficients of friction below ", *out.factor, " times these",
                  out.unique ? ": it is unique" : "; for greater ones that is unknown", " (dotyk.all_solutions lists all for few nodes in the plane)");
  return out;
}

}  // namespace dotyk::scene
