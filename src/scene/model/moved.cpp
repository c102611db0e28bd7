#include "scene/model/moved.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"

namespace dotyk::scene {
namespace {

using mesh::Mesh;
using mesh::Point;

std::shared_ptr<const Mesh> moved_mesh(const Body& body, const std::vector<double>& points) {
  require_whole(body, "another design");
  if (points.size() != body.mesh->coordinates.size())
    throw InputError(text("'", body.name, "' has ", body.mesh->node_count(), " nodes, ", body.mesh->coordinates.size(),
                          " coordinates; ", points.size(), " are given to move them to"));
  auto mesh = std::make_shared<Mesh>(*body.mesh);
  mesh->coordinates = points;
  mesh::check(*mesh, "body '" + body.name + "' where its nodes have moved to");
  return mesh;
}

/// Normals of a part's sides, found by what they were.
class TurnedNormals {
 public:
  TurnedNormals(const Mesh& before, const Mesh& after, const std::vector<mesh::Facet>& facets, const std::string& part)
      : before_(contact::sides(before, facets)), after_(contact::moved_sides(before, after, facets, part)) {}

  /// Of the node's side whose normal was `normal`; asked for in the order of contact::sides.
  const Point& of(int node, const Point& normal) {
    while (next_ < before_.size() && !(before_[next_].node == node && before_[next_].normal == normal)) ++next_;
    if (next_ == before_.size()) throw std::logic_error("a slide's normal is none of its part's sides");
    return after_[next_++].normal;
  }

 private:
  std::vector<contact::NodeSide> before_, after_;
  std::size_t next_ = 0;
};

std::string label(const Body& body, const PartMark& part) { return "'" + body.name + "' " + part.name; }

void require_along(const Body& body, const Support& support, std::size_t k, const Mesh& after) {
  for (int i = 0; i < body.dimension(); ++i)
    if (support.components[k][i] && std::abs(std::abs(support.normals[k][i]) - 1) >= kAlongAxis)
      throw InputError(text(label(body, support.part), " slides, its normal along ", "xyz"[i], ", but where its nodes have moved to the "
                            "normal is ", point_text(support.normals[k].data(), body.dimension()), " at ",
                            point_text(after.node(support.nodes[k]), body.dimension()),
                            "; a slide's part must stay straight: keep its nodes, move them along it, or fix the part"));
}

void turn(const Body& body, const Mesh& after, Support& support) {
  if (support.facets.empty()) return;
  if (support.kind != SupportKind::slide) {
    const auto now = contact::nodes(after, support.facets);
    for (std::size_t k = 0; k < now.size(); ++k) support.normals[k] = now[k].normal;
    return;
  }
  TurnedNormals turned(*body.mesh, after, support.facets, label(body, support.part));
  for (std::size_t k = 0; k < support.nodes.size(); ++k) {
    support.normals[k] = turned.of(support.nodes[k], support.normals[k]);
    require_along(body, support, k, after);
  }
}

/// Rows of one slide lie behind each other, and have one list of facets.
void turn(const Body& body, const Mesh& after, std::vector<SlideRow>& slides) {
  for (std::size_t k = 0; k < slides.size();) {
    const auto facets = slides[k].facets;
    TurnedNormals turned(*body.mesh, after, *facets, label(body, slides[k].part));
    for (; k < slides.size() && slides[k].facets == facets; ++k) slides[k].normal = turned.of(slides[k].node, slides[k].normal);
  }
}

std::shared_ptr<Body> moved_body(const std::shared_ptr<Body>& from, const std::vector<double>& points) {
  const auto mesh = moved_mesh(*from, points);
  auto body = std::make_shared<Body>(*from);
  body->origin = from->origin ? from->origin : from;
  for (Support& support : body->supports) turn(*from, *mesh, support);
  turn(*from, *mesh, body->slides);
  for (LawSupport& law : body->laws)
    law.nodes = law_sides(contact::moved_sides(*from->mesh, *mesh, law.facets, label(*from, law.part)));
  body->mesh = mesh;
  sum_loads(*body);
  require_laws_free(*body, number(*body));
  return body;
}

bool same_nodes(const Part& part, const Mesh& after) {
  const Mesh& before = *part.body->mesh;
  return std::all_of(part.facets.begin(), part.facets.end(), [&](mesh::Facet f) {
    for (int k = 0; k < before.topology().nodes_per_facet; ++k)
      if (before.point(before.facet_node(f, k)) != after.point(after.facet_node(f, k))) return false;
    return true;
  });
}

std::vector<contact::ContactRow> moved_rows(const Contact& from, const Contact& to) {
  const Part& part = to.first;
  const Mesh& before = *from.first.body->mesh;
  if (to.second.body) return contact::moved_rows(before, *from.second.body->mesh, from.rows, part.face(), to.second.face(), to.interference);
  if (!std::holds_alternative<contact::RigidGap>(to.shape))
    return contact::moved_rows(from.rows, *part.body->mesh, part.facets, to.shape, to.interference);
  if (same_nodes(from.first, *part.body->mesh)) return from.rows;
  throw InputError(text("the ", from.name, " cannot follow its part, whose nodes move: the gap is a function of the place that is asked "
                        "once; take a rigid plane or ball, or a second body"));
}

/// The contact, as it is, of another design's bodies.
std::shared_ptr<Contact> of_bodies(const std::shared_ptr<const Contact>& from, const Scene& after, int first, int second) {
  auto contact = std::make_shared<Contact>(*from);
  contact->origin = from->origin ? from->origin : from;
  contact->first.body = after.bodies[first];
  if (second >= 0) contact->second.body = after.bodies[second];
  return contact;
}

std::shared_ptr<const Contact> moved_contact(const std::shared_ptr<const Contact>& from, const Scene& before, const Scene& after) {
  const int first = before.index_of(from->first.body.get()), second = before.index_of(from->second.body.get());
  const auto rests = [&](int body) { return body < 0 || before.bodies[body] == after.bodies[body]; };
  if (rests(first) && rests(second)) return from;
  if (from->pairing != contact::Pairing::matching)
    throw InputError(text("the ", from->name, " cannot follow nodes that move: only where nodes match is it known how its rows change; "
                          "make it with matching nodes, or keep both parts' bodies at rest"));
  auto contact = of_bodies(from, after, first, second);
  if (contact->kind == Contact::Kind::glue) return contact;
  contact->rows = moved_rows(*from, *contact);
  if (second >= 0) set_weights(*contact);
  return contact;
}

}  // namespace

std::shared_ptr<Scene> copy(const Scene& scene) {
  auto result = std::make_shared<Scene>();
  for (const auto& body : scene.bodies) {
    result->bodies.push_back(std::make_shared<Body>(*body));
    result->bodies.back()->origin = body->origin ? body->origin : body;
  }
  for (const auto& contact : scene.contacts)
    result->contacts.push_back(of_bodies(contact, *result, scene.index_of(contact->first.body.get()), scene.index_of(contact->second.body.get())));
  return result;
}

std::shared_ptr<Scene> moved(const Scene& scene, const std::vector<std::vector<double>>& points) {
  if (points.size() != scene.bodies.size())
    throw InputError(text("the scene has ", scene.bodies.size(), " bodies; points are given for ", points.size()));
  auto result = std::make_shared<Scene>();
  for (std::size_t b = 0; b < points.size(); ++b)
    result->bodies.push_back(points[b].empty() ? scene.bodies[b] : moved_body(scene.bodies[b], points[b]));
  for (const auto& contact : scene.contacts) result->contacts.push_back(moved_contact(contact, scene, *result));
  return result;
}

}  // namespace dotyk::scene
