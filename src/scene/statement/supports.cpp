#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "contact/contact_row.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;
using problem::LawChoice;

/// A support of all the part's nodes, nothing prescribed yet.
Support on_nodes(const Part& part, SupportKind kind) {
  Support support{kind, part.mark(), {}, {}, {}, {}, {}, part.facets};
  for (const contact::NodeSide& n : contact::nodes(*part.body->mesh, part.facets)) {
    support.nodes.push_back(n.node);
    support.normals.push_back(n.normal);
  }
  return support;
}

/// The last support up to `s` that prescribes component i at a node, `s` itself where it names the node twice.
const Support& last_before(const Body& body, const Support& s, int node, int i) {
  const Support* last = &s;
  for (const Support* other = body.supports.data(); other != &s; ++other)
    for (std::size_t k = 0; k < other->nodes.size(); ++k)
      if (other->nodes[k] == node && other->components[k][i]) last = other;
  return *last;
}

bool shares_facet(const LawSupport& a, const LawSupport& b) {
  const std::set<mesh::Facet> of_a(a.facets.begin(), a.facets.end());
  return std::any_of(b.facets.begin(), b.facets.end(), [&](const mesh::Facet& f) { return of_a.contains(f); });
}

bool given(const problem::LawAlong& law) { return law->acts(); }

void require_no_other(const Body& body, const LawSupport& added) {
  for (const LawSupport& known : body.laws) {
    const bool normal = given(known.normal) && given(added.normal);
    if ((!normal && !(given(known.tangential) && given(added.tangential))) || !shares_facet(known, added)) continue;
    throw InputError(text("part '", added.part.name, "' of '", body.name, "' has a ", normal ? "normal" : "tangential", " law already, ",
                          (normal ? known.normal : known.tangential).law.spec->words,
                          known.part == added.part ? "" : ", as part of '" + known.part.name + "'"));
  }
}

/// Is a law along these directions, or one of them, of use at one node at least?
template <class Directions>
void require_free(const Body& body, const elasticity::Numbering& numbering, const LawSupport& on, const char* which, const problem::LawAlong& law,
                  const Directions& directions) {
  if (!given(law)) return;
  for (const contact::NodeSide& side : on.nodes)
    for (const Point& d : directions(side))
      if (moves(body, numbering, side, d)) return;
  throw InputError(text("contradictory supports on '", body.name, "': the ", which, " displacement of part '", on.part.name,
                        "' is held at each of its nodes, and has the law ", law.law.spec->words, " as well"));
}

void require_normal_force(const Body& body, const LawSupport& on) {
  if (on.tangential->follows && !given(on.normal))
    throw InputError(text("part '", on.part.name, "' of '", body.name, "' has Coulomb friction and no normal law: its bound is mu times the normal reaction; give 'normal', or given friction"));
}

std::vector<Point> places(const Body& body, const std::vector<contact::NodeSide>& sides) {
  std::vector<Point> x;
  for (const contact::NodeSide& side : sides) x.push_back(body.mesh->point(side.node));
  return x;
}

}  // namespace

elasticity::Numbering number(const Body& body) {
  const int dim = body.dimension();
  std::vector<char> fixed(body.mesh->coordinates.size(), 0);
  double largest = 0;
  for (const Support& s : body.supports)
    for (const mesh::Point& v : s.values)
      for (int i = 0; i < dim; ++i) largest = std::max(largest, std::abs(v[i]));
  std::vector<double> value(largest > 0 ? fixed.size() : 0, 0.0);
  for (const Support& s : body.supports)
    for (std::size_t k = 0; k < s.nodes.size(); ++k)
      for (int i = 0; i < dim; ++i) {
        if (!s.components[k][i]) continue;
        const std::size_t at = static_cast<std::size_t>(s.nodes[k]) * dim + i;
        if (largest > 0 && fixed[at] && std::abs(value[at] - s.values[k][i]) > 1e-12 * largest)
          throw InputError(text("contradictory supports on '", body.name, "': at the node ",
                                point_text(body.mesh->node(s.nodes[k]), dim), " part '", last_before(body, s, s.nodes[k], i).part.name,
                                "' prescribes u", "xyz"[i], " = ", value[at], " and part '", s.part.name,
                                "' prescribes ", s.values[k][i]));
        fixed[at] = 1;
        if (largest > 0) value[at] = s.values[k][i];
      }
  return elasticity::number(*body.mesh, fixed, std::move(value));
}

void hold(Body& body, const std::function<void(Body&)>& change) {
  Body changed = body;
  change(changed);
  require_laws_free(changed, number(changed));
  body = std::move(changed);
}

void fix(Part& part, const std::array<bool, 3>& components) {
  Support support = on_nodes(part, SupportKind::fix);
  support.components.assign(support.nodes.size(), components);
  support.values.assign(support.nodes.size(), {0, 0, 0});
  hold(*part.body, [&](Body& body) { body.supports.push_back(std::move(support)); });
}

void slide(Part& part) {
  Support support{SupportKind::slide, part.mark(), {}, {}, {}, {}, {}, part.facets};
  const auto facets = std::make_shared<const std::vector<mesh::Facet>>(part.facets);
  std::vector<SlideRow> oblique;
  for (const contact::NodeSide& side : contact::sides(*part.body->mesh, part.facets)) {
    std::array<bool, 3> along{false, false, false};
    bool axis = false;
    for (int i = 0; i < part.body->dimension(); ++i) {
      along[i] = std::abs(std::abs(side.normal[i]) - 1) < kAlongAxis;
      axis = axis || along[i];
    }
    if (axis) {
      support.nodes.push_back(side.node);
      support.components.push_back(along);
      support.values.push_back({0, 0, 0});
      support.normals.push_back(side.normal);
    } else {
      oblique.push_back({support.part, side.node, side.normal, facets});
    }
  }
  hold(*part.body, [&](Body& body) {
    if (!support.nodes.empty()) body.supports.push_back(std::move(support));
    body.slides.insert(body.slides.end(), oblique.begin(), oblique.end());
  });
}

void displace(Part& part, const std::array<elasticity::ScalarField, 3>& components, const std::string& load_case) {
  Support support = on_nodes(part, SupportKind::displace);
  support.load_case = load_case;
  std::array<bool, 3> given;
  for (int i = 0; i < 3; ++i) given[i] = static_cast<bool>(components[i]);
  support.components.assign(support.nodes.size(), given);
  for (int n : support.nodes) {
    mesh::Point value{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      if (given[i]) value[i] = components[i](part.body->mesh->point(n));
    support.values.push_back(value);
  }
  hold(*part.body, [&](Body& body) { body.supports.push_back(std::move(support)); });
}

problem::LawAlong GivenLaw::at(const std::vector<Point>& places, int dimension) const {
  problem::LawAlong along{varies && !places.empty() ? varies(places.front()) : law};
  for (std::size_t k = 0; varies && k < places.size(); ++k) {
    const auto here = [&] { return point_text(places[k].data(), dimension); };
    const LawChoice own = varies(places[k]);
    if (own.spec != along.law.spec) throw InputError(text("the law is ", along.law.spec->words, " at one node and ", own.spec->words, " at ", here(), "; parts with laws of their own may differ"));
    problem::require_valid(own, " at " + here());
    along.at.push_back(own.numbers);
  }
  if (!varies) problem::require_valid(law);
  if (std::all_of(along.at.begin(), along.at.end(), [&](const auto& numbers) { return numbers == along.law.numbers; })) along.at.clear();
  return along;
}

void require_normal(const problem::LawAlong& law) {
  if (law->follows) throw InputError(text("a ", law.law.spec->words, " law cannot be normal: its bound follows the normal force; give it as tangential"));
}

void require_tangential(const problem::LawAlong& law, int dimension) {
  const bool plane = dimension == 2;
  const char* allowed = plane ? "free, prescribed, load, elastic, friction and capped_elastic"
                              : "free, prescribed(0), elastic and friction, which have no direction of their own";
  const auto refuse = [&](const std::string& why) {
    throw InputError(text("a ", law.law.spec->words, " law cannot be tangential: ", why,
                          "; a tangential law ", plane ? "in the plane" : "in space", " is one of ", allowed));
  };
  if (law->one_sided()) refuse("slip to either side is alike, and nothing is open");
  if (law->directed()) refuse("slip to either side is alike");
  if (plane) return;
  if (law->load) refuse("it does not say along which tangent (part:load does)");
  if (law->prescribes && law.moves()) refuse("it does not say along which tangent (part:displace does)");
  if (law->elastic() && law->yields()) refuse("a spring that slips is not among the laws of two components");
}

std::vector<contact::NodeSide> law_sides(std::vector<contact::NodeSide> sides) {
  for (contact::NodeSide& side : sides)
    for (double& n : side.normal)
      if (std::abs(n) < 1e-12) n = 0;
  return sides;
}

bool unknown_along(const elasticity::Numbering& numbering, const std::vector<contact::NodeWeight>& nodes, const Point& direction, int dimension) {
  for (const contact::NodeWeight& n : nodes)
    for (int i = 0; i < dimension; ++i)
      if (direction[i] != 0 && numbering.unknown[static_cast<std::size_t>(n.node) * dimension + i] >= 0) return true;
  return false;
}

bool moves(const Body& body, const elasticity::Numbering& numbering, const contact::NodeSide& side, const Point& direction) {
  const auto slides = [&](int node) {
    return std::any_of(body.slides.begin(), body.slides.end(),
                       [&](const SlideRow& slide) { return slide.node == node && std::abs(mesh::dot(slide.normal, direction)) > 1 - 1e-9; });
  };
  return std::any_of(side.own.begin(), side.own.end(), [&](const contact::NodeWeight& own) {
    return !slides(own.node) && unknown_along(numbering, {own}, direction, body.dimension());
  });
}

void require_laws_free(const Body& body, const elasticity::Numbering& numbering) {
  for (const LawSupport& on : body.laws) {
    require_free(body, numbering, on, "normal", on.normal, [](const contact::NodeSide& s) { return std::vector<Point>{s.normal}; });
    require_free(body, numbering, on, "tangential", on.tangential,
                 [&](const contact::NodeSide& s) { return contact::tangents(s.normal, body.dimension()); });
  }
}

std::string describe(const LawSupport& support) {
  std::string out = given(support.normal) ? "normal " + problem::describe(support.normal) : "";
  if (given(support.tangential)) out += (out.empty() ? "" : "; ") + ("tangential " + problem::describe(support.tangential));
  return out;
}

void support(Part& part, const GivenLaw& normal, const GivenLaw& tangential) {
  Body& body = *part.body;
  LawSupport added{part.mark(), part.facets, law_sides(contact::corner_sides(*part.body->mesh, part.facets)), {}, {}};
  const std::vector<Point> x = places(body, added.nodes);
  added.normal = normal.at(x, body.dimension()), added.tangential = tangential.at(x, body.dimension());
  require_normal(added.normal);
  require_tangential(added.tangential, body.dimension());
  require_no_other(body, added);
  hold(body, [&](Body& changed) {
    const auto same = std::find_if(changed.laws.begin(), changed.laws.end(), [&](const LawSupport& l) { return l.part == added.part; });
    if (same == changed.laws.end()) {
      changed.laws.push_back(std::move(added));
    } else {
      if (given(added.normal)) same->normal = added.normal;
      if (given(added.tangential)) same->tangential = added.tangential;
    }
    for (const LawSupport& on : changed.laws) require_normal_force(changed, on);
  });
}

}  // namespace dotyk::scene
