#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "elasticity/rigid_modes.hpp"
#include "scene/solve/doubts.hpp"
#include "scene/model/model.hpp"
#include "scene/statement/scene.hpp"
#include "scene/solve/uniqueness.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/near_rows.hpp"

namespace dotyk::scene {
namespace {

std::string describe_body(const Body& body) {
  return text("  '", body.name, "': ", body.mesh->topology().name, " ", body.mesh->topology().shapes, ", ",
              body.mesh->node_count(), " nodes, ", body.mesh->cell_count(), " cells");
}

std::string describe_contact(const Contact& contact) {
  static const char* pairing[] = {" node pairs", " nodes, node to segment", " nodes, mortar"};
  static const char* how[] = {"", ", node to segment", ", mortar"};
  if (contact.kind == Contact::Kind::glue)
    return text("  ", contact.name, ": ", contact.glued.size(), pairing[static_cast<int>(contact.pairing)]);
  const char* multipliers =
      contact.discretisation.multipliers == contact::Multipliers::p1_p0 ? ", multipliers P1-P0" : "";
  using LawKind = problem::SupportLaw::Kind;
  const std::string normal = contact.normal.kind == LawKind::signorini ? "" : "normal " + problem::describe(contact.normal) + ", ";
  return text("  ", contact.name, ": ", contact.rows.size(), " rows, ", normal,
              contact.friction == Friction::Kind::tresca    ? std::all_of(contact.friction_value.begin(), contact.friction_value.end(), [](double g) { return std::isinf(g); }) ? "no slip" : "given friction"
              : contact.friction == Friction::Kind::coulomb ? "Coulomb friction"
              : contact.tangential.kind == LawKind::free    ? "frictionless"
                                                            : "tangential " + problem::describe(contact.tangential),
              how[static_cast<int>(contact.pairing)], multipliers);
}

/// Work and memory of condensed rows where they are worth a word. Kernels reach some 20 Gflop/s a core.
std::string expected(const problem::Problem& problem) {
  constexpr double kLeast = 2e9, kRate = 2e10, kMuch = 0.5;
  const solver::DefaultMethod chosen = solver::default_method(problem);
  if (chosen != solver::DefaultMethod::pdas && chosen != solver::DefaultMethod::newton) return "";
  const solver::NearRows near(problem, {});
  const problem::CondensingWork work = problem::work_of_condensing(near.all() ? problem : near.restricted());
  if (work.flops < kLeast) return "";
  std::string out = text("; ", near.all() ? "" : text("first on the ", near.count(), " rows that overlap, "), "some ", std::ceil(work.flops * 1e-9), " Gflop, ",
                         std::ceil(work.flops / kRate), " s on a core, and ", std::ceil(work.bytes * 1e-6), " MB");
  if (problem::dense_bytes(near.count()) > kMuch * work.bytes) out += "; warning: most of it is the dense matrices of the rows; feti forms none";
  return out;
}

/// The method that solves it where none is named, and why.
std::string method(const problem::Problem& problem, bool any_free) {
  const std::string factored = text(" (", problem.unknowns(), " unknowns factored once", expected(problem), ")");
  switch (solver::default_method(problem)) {
    case solver::DefaultMethod::linear: return text("one linear solve of ", problem.unknowns(), " unknowns");
    case solver::DefaultMethod::newton: return "newton on the condensed rows of contact and friction" + factored;
    case solver::DefaultMethod::held:
      return text("pdas on all ", problem.unknowns(), " unknowns, one sparse factorisation an iteration (reduced = false): its ", problem.rows(),
                  " rows need not be condensed, or are too many");
    case solver::DefaultMethod::multigrid: {
      const solver::Expected seconds = solver::expected(problem);
      return text("pdas on all ", problem.unknowns(), " unknowns, linear systems by conjugate gradients with multigrid (linear = \"multigrid\"): some ",
                  std::ceil(seconds.multigrid), " s on a core, where factors and condensed rows would take some ", std::ceil(seconds.condensed), " s");
    }
    case solver::DefaultMethod::pdas: break;
  }
  return text("pdas on ", problem.rows(), " condensed rows", factored, ": finite and exact for frictionless contact",
              any_free ? "; rigid motions exactly, as constraints of the dual (to compare: magnetic screws, pdas{ kernel = \"screws\" })" : "");
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
  try {
    const Model model = build(scene, clock, quiet);
    how = method(model.problem, any_free);
    return out + how + "\n  " + verdict(scene, model);
  } catch (const InputError& error) {
    return out + how + "\n  no solution: " + error.what();
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
  std::string out = "plan:";
  int free = 0;
  for (const auto& body : scene.bodies) {
    const auto numbering = number(*body);
    const auto rigid = elasticity::rigid_modes(*body->mesh, numbering, body->facet_springs());
    free += static_cast<int>(rigid.motions.size());
    out += "\n" + describe_body(*body) + text(", ", numbering.count(), " unknowns");
    out += rigid.motions.empty() ? "; held by its supports" : body->laws.empty() ? "; free to move but for contact: "
                                   : "; free to move but for contact and laws of supports: ";
    for (std::size_t k = 0; k < rigid.motions.size(); ++k) out += (k ? ", " : "") + rigid.motions[k].text();
    for (const LawSupport& on : body->laws) out += text("\n    on ", on.part.name, " (", on.nodes.size(), " nodes): ", describe(on));
  }
  for (const auto& contact : scene.contacts) out += "\n" + describe_contact(*contact);
  return out + method_and_verdict(scene, free > 0) + describe(doubts(scene));
}

}  // namespace dotyk::scene
