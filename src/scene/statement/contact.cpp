#include <cmath>
#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "scene/statement/scene.hpp"

namespace dotyk::scene {

namespace {

/// What all designs of a body or contact have in common.
template <class T>
const T* root(const T* one) {
  return one && one->origin ? one->origin.get() : one;
}

template <class T>
int find_root(const std::vector<T>& list, const void* wanted) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (root(&*list[k]) == wanted) return static_cast<int>(k);
  return -1;
}

void require_member(const Scene& scene, const Part& part) {
  const int index = scene.index_of(part.body.get());
  if (index >= 0 && scene.bodies[index] == part.body) return;
  if (index >= 0)
    throw InputError(text("part '", part.name, "' belongs to another design of '", part.body->name, "' than this scene's"));
  std::string all;
  for (const auto& body : scene.bodies) all += (all.empty() ? "'" : ", '") + body->name + "'";
  throw InputError(text("part '", part.name, "' belongs to '", part.body->name,
                        "', which is not in this scene; its bodies are ", all));
}

/// The (node, partner) pairs of a contact or a glue.
std::set<std::pair<int, int>> pairs_of(const Contact& contact, bool swapped) {
  std::set<std::pair<int, int>> pairs;
  const auto add = [&](int a, int b) { swapped ? pairs.emplace(b, a) : pairs.emplace(a, b); };
  const auto add_all = [&](int node, const std::vector<contact::NodeWeight>& partners) {
    for (const contact::NodeWeight& partner : partners) add(node, partner.node);
  };
  for (const contact::ContactRow& row : contact.rows) add_all(row.node, row.partners);
  for (const contact::Tie& tie : contact.glued) add_all(tie.node, tie.partners);
  return pairs;
}

/// Throws InputError where every pair of the new contact is already joined by another: its pressure would be
/// shared out between the two, or it could never open.
void refuse_repetition(const Scene& scene, const Contact& fresh) {
  for (const auto& known : scene.contacts) {
    const bool same = known->first.body == fresh.first.body && known->second.body == fresh.second.body;
    const bool swapped = known->first.body == fresh.second.body && known->second.body == fresh.first.body;
    if (!known->second.body || (!same && !swapped)) continue;
    const auto there = pairs_of(*known, swapped && !same), here = pairs_of(fresh, false);
    if (std::includes(there.begin(), there.end(), here.begin(), here.end()))
      throw InputError(text("the nodes of this ", fresh.kind == Contact::Kind::glue ? "glue" : "contact",
                            " are already joined by the ", known->name, "; say it once"));
  }
}

/// The same of a contact with a rigid shape: the same rows as one that is there.
void refuse_repeated_shape(const Scene& scene, const Contact& fresh) {
  for (const auto& known : scene.contacts) {
    if (known->second.body || known->first.body != fresh.first.body || known->rows.size() != fresh.rows.size()) continue;
    const bool same = std::equal(known->rows.begin(), known->rows.end(), fresh.rows.begin(), [](const contact::ContactRow& a, const contact::ContactRow& b) {
      return a.node == b.node && a.normal == b.normal && a.gap == b.gap;
    });
    if (same) throw InputError(text("there is the same ", known->name, " already; say it once"));
  }
}

/// Throws InputError where an interface of two parts, or of a part and a rigid shape, cannot have the law.
void require_of_interface(const Contact& contact) {
  const auto refuse = [&](const problem::LawAlong& law, const char* direction, const std::string& why) {
    throw InputError(text("the ", contact.name, " cannot have the ", direction, " law ", law.law.spec->words, ": ", why));
  };
  if (contact.normal->load) refuse(contact.normal, "normal", "a given pressure is no law of an interface; part:pressure on each part is the same");
  if (contact.normal->breaks) refuse(contact.normal, "normal", "only supports break (part:support); its force is not monotone, and a contact's nodes have no memory of it");
  require_normal(contact.normal);
  require_tangential(contact.tangential, contact.first.body->dimension());
  if (contact.tangential->load) refuse(contact.tangential, "tangential", "a given shear is no law of an interface; part:load on each part is the same");
  if (contact.tangential.moves()) refuse(contact.tangential, "tangential", "a given slip is not known; prescribed(0) is no slip");
  if (contact.tangential->follows && !contact.normal->acts())
    refuse(contact.normal, "normal", "Coulomb's bound is mu times the normal force, and here there is none; take given friction");
}

/// Sets the laws, their numbers at the contact nodes.
void set_laws(Contact& contact, const InterfaceLaws& laws) {
  std::vector<mesh::Point> places;
  for (const contact::ContactRow& row : contact.rows) places.push_back(contact.first.body->mesh->point(row.node));
  contact.normal = laws.normal.at(places, contact.first.body->dimension());
  contact.tangential = laws.tangential.at(places, contact.first.body->dimension());
  require_of_interface(contact);
  if (contact.tangential->prescribes) contact.tangential = {{&problem::laws::friction, {INFINITY}}};
}

/// Throws InputError where the friction does not go with the multipliers.
void set_discretisation(Contact& contact, const Discretisation& discretisation) {
  contact.discretisation = discretisation;
  const bool own_size = discretisation.friction_size > 0;
  if (own_size && (discretisation.multipliers == contact::Multipliers::nodal ||
                   !contact.tangential->rubs()))
    throw InputError("'friction_size' is the size of the cells of friction with multipliers = \"P1-P0\"; it is given "
                     "without them");
  if (discretisation.ends != CellEnds::own && (discretisation.multipliers == contact::Multipliers::nodal ||
                                               !contact.tangential->rubs() || contact.first.body->dimension() != 2))
    throw InputError("'friction_ends' is about the cells of friction on a line, with multipliers = \"P1-P0\"; it is given "
                     "without them");
  if (discretisation.multipliers == contact::Multipliers::nodal) return;
  const bool elastic = contact.tangential->elastic();
  if (!contact.normal->stop() || elastic)
    throw InputError("multipliers = \"P1-P0\" are for Signorini's law with given friction: other laws tell the force at a node by what happens there; take \"nodal\"");
  for (const Part* part : {&contact.first, &contact.second})
    if (part->body && part->body->mesh->topology().order == 2)
      throw InputError(text("multipliers = \"P1-P0\" are for cells of order 1; '", part->body->name, "' is of ", part->body->mesh->topology().name,
                            ", whose pressure is P1 as it is"));
  if (contact.pairing != contact::Pairing::matching)
    throw InputError("multipliers = \"P1-P0\" are for matching nodes; with nodes that do not match take \"nodal\"");
  if (contact.tangential->follows)
    throw InputError("Coulomb friction does not go with multipliers = \"P1-P0\": their friction rows are weighted "
                     "with the bound, which here follows from the pressure sought; take \"nodal\"");
  const auto infinite = std::count_if(contact.tangential.at.begin(), contact.tangential.at.end(), [](const auto& numbers) { return std::isinf(numbers[0]); });
  if (infinite > 0 && infinite < std::ssize(contact.tangential.at))
    throw InputError("the friction bound is infinite on a part of the contact only; with multipliers = \"P1-P0\" it "
                     "must be finite, or infinite everywhere");
}

std::shared_ptr<const Contact> keep(Scene& scene, Contact contact) {
  scene.contacts.push_back(std::make_shared<const Contact>(std::move(contact)));
  return scene.contacts.back();
}

}  // namespace

int Scene::index_of(const Body* body) const { return find_root(bodies, root(body)); }
int Scene::index_of(const Contact& contact) const { return find_root(contacts, root(&contact)); }

void require_whole(const Scene& scene, const std::string& what) {
  for (const auto& body : scene.bodies) require_whole(*body, what);
}

std::shared_ptr<Scene> make_scene(std::vector<std::shared_ptr<Body>> bodies) {
  if (bodies.empty()) throw InputError("a scene needs at least one body");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i]->dimension() != bodies[0]->dimension())
      throw InputError(text("'", bodies[i]->name, "' is ", bodies[i]->dimension(), "-D, '",
                            bodies[0]->name, "' is ", bodies[0]->dimension(),
                            "-D; the bodies of a scene must have one dimension"));
    for (std::size_t j = 0; j < i; ++j) {
      if (bodies[i] == bodies[j]) throw InputError(text("'", bodies[i]->name, "' is given twice"));
      if (bodies[i]->name == bodies[j]->name)
        throw InputError(text("two bodies are named '", bodies[i]->name,
                              "'; give each a name of its own (body{ name = … })"));
    }
  }
  auto scene = std::make_shared<Scene>();
  scene->bodies = std::move(bodies);
  return scene;
}

void set_weights(Contact& contact) {
  const std::vector<double> measures = contact::measures(surface_of(contact));
  for (std::size_t k = 0; k < measures.size(); ++k)
    if (measures[k] > 0) contact.rows[k].weight = measures[k];
}

contact::Surface surface_of(const Contact& contact) {
  const bool itself = contact.second.body && contact.first.body->mesh == contact.second.body->mesh;
  return contact::surface(*contact.first.body->mesh, contact.first.facets, contact.rows,
                          itself ? contact.second.facets : std::vector<mesh::Facet>());
}

std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& first, const Part& second,
                                           const elasticity::ScalarField& added_gap, const InterfaceLaws& laws,
                                           bool interference, const Discretisation& discretisation,
                                           std::optional<contact::Pairing> pairing, Monitor* monitor) {
  require_member(scene, first);
  require_member(scene, second);
  const Stopwatch watch;
  Contact contact;
  contact.name = "contact of " + first.label() + " with " + second.label();
  contact.first = first;
  contact.second = second;
  contact.interference = interference;
  contact::PairedRows paired = contact::pair_rows(first.face(), second.face(), pairing, added_gap, interference, monitor);
  contact.pairing = paired.pairing;
  contact.rows = std::move(paired.rows);
  contact.turned = paired.turned;
  if (contact.turned) std::swap(contact.first, contact.second);
  if (contact.pairing != contact::Pairing::mortar && contact.first.body->mesh->topology().order == 1) set_weights(contact);
  set_laws(contact, laws);
  set_discretisation(contact, discretisation);
  refuse_repetition(scene, contact);
  contact.seconds = watch.seconds();
  return keep(scene, std::move(contact));
}

std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& part, const contact::RigidShape& shape,
                                           const elasticity::ScalarField& added_gap, bool interference,
                                           const InterfaceLaws& laws, const Discretisation& discretisation) {
  require_member(scene, part);
  Contact contact;
  contact.name = text("contact of ", part.label(), " with a ", contact::name(shape));
  contact.first = part;
  contact.interference = interference;
  contact.rows = contact::against(*part.body->mesh, part.facets, shape, added_gap, interference);
  refuse_repeated_shape(scene, contact);
  set_laws(contact, laws);
  set_discretisation(contact, discretisation);
  contact.shape = shape;
  if (auto* gap = std::get_if<contact::RigidGap>(&contact.shape)) gap->gap = nullptr;
  return keep(scene, std::move(contact));
}

std::shared_ptr<const Contact> add_glue(Scene& scene, const Part& first, const Part& second,
                                        std::optional<contact::Pairing> pairing, Monitor* monitor) {
  require_member(scene, first);
  require_member(scene, second);
  const Stopwatch watch;
  Contact contact;
  contact.kind = Contact::Kind::glue;
  contact.name = "glue of " + first.label() + " to " + second.label();
  contact.first = first;
  contact.second = second;
  contact::PairedTies paired = contact::pair_ties(first.face(), second.face(), pairing, monitor);
  contact.pairing = paired.pairing;
  contact.glued = std::move(paired.ties);
  refuse_repetition(scene, contact);
  contact.seconds = watch.seconds();
  return keep(scene, std::move(contact));
}

}  // namespace dotyk::scene
