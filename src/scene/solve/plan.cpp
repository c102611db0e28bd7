#include "base/error.hpp"
#include "base/text.hpp"
#include "elasticity/rigid_modes.hpp"
#include "scene/solve/doubts.hpp"
#include "scene/model/model.hpp"
#include "scene/statement/scene.hpp"
#include "scene/solve/uniqueness.hpp"
#include "solver/core/default_method.hpp"

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
              contact.friction == Friction::Kind::tresca    ? "given friction"
              : contact.friction == Friction::Kind::coulomb ? "Coulomb friction"
              : contact.tangential.kind == LawKind::free    ? "frictionless"
                                                            : "tangential " + problem::describe(contact.tangential),
              how[static_cast<int>(contact.pairing)], multipliers);
}

/// The method that solves it where none is named, and why.
std::string method(const problem::Problem& problem, bool any_free) {
  const std::string factored = text(" (", problem.unknowns(), " unknowns factored once)");
  switch (solver::default_method(problem)) {
    case solver::DefaultMethod::linear: return text("one linear solve of ", problem.unknowns(), " unknowns");
    case solver::DefaultMethod::newton: return "newton on the condensed rows of contact and friction" + factored;
    case solver::DefaultMethod::sparse_pdas:
      return text("pdas on all ", problem.unknowns(), " unknowns, one sparse factorisation an iteration (reduced = false): ", problem.rows(),
                  " rows are too many to condense");
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
