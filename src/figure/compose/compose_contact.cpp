// Contacts of a scene figure, and the rigid obstacles as their nodes see them.
#include "figure/compose/compose.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <set>
#include <tuple>

#include "figure/canvas/geometry.hpp"

namespace dotyk::figure {
namespace {

using scene::Contact;

/// Positions in `nodes` of each contact facet's nodes; at a corner the entry of the facet's own side.
std::vector<int> contact_facets(const Contact& contact, const std::vector<scene::ContactNode>& nodes) {
  std::multimap<int, int> entries;
  for (std::size_t k = 0; k < nodes.size(); ++k) entries.emplace(nodes[k].node, static_cast<int>(k));
  const mesh::Mesh& mesh = *contact.first.body->mesh;
  std::vector<int> result;
  for (const mesh::Facet f : contact.first.facets) {
    const mesh::Point normal = mesh.facet_area_vector(f);
    std::vector<int> found;
    for (int k = 0; k < mesh.topology().facet_corners; ++k) {
      const auto [first, last] = entries.equal_range(mesh.facet_node(f, k));
      int best = -1;
      double most = -INFINITY;
      for (auto it = first; it != last; ++it) {
        const double along = mesh::dot(normal, nodes[it->second].normal);
        if (along > most) most = along, best = it->second;
      }
      if (best >= 0) found.push_back(best);
    }
    if (static_cast<int>(found.size()) == mesh.topology().facet_corners)
      result.insert(result.end(), found.begin(), found.end());
  }
  return result;
}

constexpr double kBeyond = 0.06;  // of the scene's size
constexpr double kFacing = 0.05;  // least cosine between a facet's normal and the direction to the obstacle

/// The rows with a facet that faces the obstacle: not those on the sides of a block that stands on a plane.
std::vector<bool> facing(const Contact& contact) {
  std::vector<bool> result;
  for (const contact::ContactRow& row : contact.rows)
    result.push_back(std::any_of(row.facets.begin(), row.facets.end(), [&](int f) {
      return mesh::dot(mesh::unit(contact.first.body->mesh->facet_area_vector(contact.first.facets[f])), row.normal) > kFacing;
    }));
  return result;
}

/// The greatest gap at rest that is magnified: c of the header.
double most_magnified(const Contact& contact, const scene::ContactResult& result) {
  if (!std::holds_alternative<contact::RigidPlane>(contact.shape)) return INFINITY;
  double most = 0;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) most = std::max(most, contact.rows[k].gap - result.nodes[k].gap);
  return most;
}

/// Where the obstacle is drawn, as each node sees it; see the header.
std::vector<Vec3> seen_by_nodes(const Contact& contact, const scene::ContactResult& result, const Vec3& move, double factor) {
  const bool touches = result.area > 0;
  const double most = most_magnified(contact, result);
  std::vector<Vec3> at;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) {
    const contact::ContactRow& row = contact.rows[k];
    const Vec3 way = touches ? plus(result.nodes[k].displacement, move, -1) : Vec3{0, 0, 0};
    const double magnified = std::min(row.gap, most) - mesh::dot(way, row.normal);  // with `way`: along n in place of w·n
    Vec3 x = plus(result.nodes[k].x, row.normal, row.gap + (factor - 1) * magnified);
    x = plus(plus(x, move, factor), way, factor - 1);
    at.push_back(x);
  }
  return at;
}

/// Whether gaps at rest that can be seen are drawn larger.
bool magnifies(const Contact& contact, const scene::ContactResult& result, double size) {
  const double most = most_magnified(contact, result);
  return std::ranges::any_of(contact.rows, [&](const contact::ContactRow& row) { return std::abs(std::min(row.gap, most)) > 1e-6 * size; });
}

/// The points in their order along the part, of a plane along that; separate pieces follow each other by the coordinate across `outward`. The line of a
/// plane goes beyond both ends.
std::vector<double> polyline(const Contact& contact, const scene::ContactResult& result, const std::vector<Vec3>& at,
                             const std::vector<int>& place, const Vec3& outward, double beyond) {
  const auto across = [&](int k) { return result.nodes[k].x[1] * outward[0] - result.nodes[k].x[0] * outward[1]; };
  std::vector<std::vector<int>> pieces = chains(contact_facets(contact, result.nodes));
  if (pieces.empty())  // corners alone
    for (int k = 0; k < static_cast<int>(at.size()); ++k) pieces.push_back({k});
  for (std::vector<int>& piece : pieces)
    if (across(piece.front()) > across(piece.back())) std::ranges::reverse(piece);
  std::ranges::sort(pieces, {}, [&](const std::vector<int>& piece) { return across(piece.front()); });
  std::vector<Vec3> ordered;
  for (const std::vector<int>& piece : pieces)
    for (const int k : piece)
      if (place[k] >= 0) ordered.push_back(at[k]);
  if (std::holds_alternative<contact::RigidPlane>(contact.shape)) std::ranges::stable_sort(ordered, {}, [&](const Vec3& x) { return x[1] * outward[0] - x[0] * outward[1]; });
  if (const auto* plane = std::get_if<contact::RigidPlane>(&contact.shape); plane && !ordered.empty()) {
    const Vec3 along{plane->normal[1], -plane->normal[0], 0};  // the way of the order, as `outward` is −normal
    // As it goes on where it ends: a magnification tilts a plane that is not along the part.
    const auto beyond_end = [&](const auto& inwards, double sense) {
      const Vec3& end = *inwards.begin();
      const auto before = std::ranges::find_if(inwards, [&](const Vec3& x) { return length(plus(x, end, -1)) > 1e-6 * beyond; });
      return plus(end, before == inwards.end() ? plus({0, 0, 0}, along, sense) : unit(plus(end, *before, -1)), beyond);
    };
    const Vec3 first = beyond_end(ordered, -1), last = beyond_end(ordered | std::views::reverse, 1);
    ordered.insert(ordered.begin(), first);
    ordered.push_back(last);
  }
  std::vector<double> points;
  for (const Vec3& x : ordered) points.insert(points.end(), x.begin(), x.end());
  return points;
}

/// The facets cut into triangles, those whose nodes all have a place.
std::vector<int> triangles(const Contact& contact, const scene::ContactResult& result, const std::vector<int>& place) {
  const auto facets = contact_facets(contact, result.nodes);
  const int per_facet = contact.first.body->mesh->topology().facet_corners;
  std::vector<int> out;
  for (std::size_t f = 0; f + per_facet <= facets.size(); f += per_facet)
    for (int t = 0; t + 2 < per_facet; ++t) {
      const int corner[3] = {place[facets[f]], place[facets[f + t + 1]], place[facets[f + t + 2]]};
      if (corner[0] >= 0 && corner[1] >= 0 && corner[2] >= 0) out.insert(out.end(), corner, corner + 3);
    }
  return out;
}

/// The contact as the second body has it: across the gap, seen from the other side.
ContactPicture other_side(ContactPicture contact) {
  for (ContactNode& node : contact.nodes) {
    node.position = plus(node.position, node.normal, node.rest_gap);
    node.displacement = plus(node.displacement, node.normal, node.gap - node.rest_gap);
    node.normal = plus({0, 0, 0}, node.normal, -1);
  }
  return contact;
}

ContactPicture moved(ContactPicture contact, const Vec3& by) {
  for (ContactNode& node : contact.nodes) node.position = plus(node.position, by);
  contact.apart = true;
  return contact;
}

/// Of several contacts on the same facets one tells the state of a node: that with the greatest pressure there, else that with the least gap.
void cover(const Solution& s, const std::vector<std::pair<const Contact*, std::size_t>>& contacts, std::vector<ContactPicture>& pictures) {
  std::map<std::tuple<int, mesh::Facet, int>, std::tuple<double, double, std::size_t>> told;  // by body, facet, node
  for (const bool covers : {false, true})
    for (const auto& [contact, number] : contacts)
      for (std::size_t k = 0; k < contact->rows.size(); ++k) {
        ContactNode& node = pictures[number].nodes[k];
        bool covered = !contact->rows[k].facets.empty();
        for (const int f : contact->rows[k].facets) {
          const std::tuple rank(-node.pressure, node.gap, number);
          auto& best = told.try_emplace({s.scene().index_of(contact->first.body.get()), contact->first.facets[f], contact->rows[k].node}, rank).first->second;
          best = std::min(best, rank);
          covered = covered && best != rank;
        }
        if (covers) node.covered = covered;
      }
}

/// Finds the nodes where facets beside the part go on as those of the part do. A plane has no edge: there the part ends, not what presses.
void find_sharp(const Contact& contact, ContactPicture& picture) {
  constexpr double kSmooth = 0.9;  // least cosine
  if (std::holds_alternative<contact::RigidPlane>(contact.shape)) return;
  const mesh::Mesh& mesh = *contact.first.body->mesh;
  const std::set<mesh::Facet> part(contact.first.facets.begin(), contact.first.facets.end());
  std::multimap<int, ContactNode*> nodes;
  for (std::size_t k = 0; k < picture.nodes.size(); ++k) nodes.emplace(contact.rows[k].node, &picture.nodes[k]);
  for (const mesh::Facet f : mesh::boundary(mesh))
    for (int k = 0; k < mesh.topology().facet_corners && !part.contains(f); ++k)
      for (auto [at, end] = nodes.equal_range(mesh.facet_node(f, k)); at != end; ++at)
        at->second->sharp |= mesh::dot(mesh::unit(mesh.facet_area_vector(f)), at->second->normal) > kSmooth;
}

}  // namespace

ContactPicture contact_picture(const Contact& contact, const scene::ContactResult& result, const std::vector<double>& displacement) {
  ContactPicture picture;
  picture.name = contact.first.body->name + (contact.second.body ? " – " + contact.second.body->name : "");
  picture.nodes_per_facet = contact.first.body->mesh->topology().facet_corners;
  picture.facets = contact_facets(contact, result.nodes);
  for (std::size_t k = 0; k < result.nodes.size(); ++k) {
    const scene::ContactNode& n = result.nodes[k];
    // Not n.x: the mean position of what a node of mortar stands for may lie off the node.
    picture.nodes.push_back({contact.first.body->mesh->point(n.node), mesh::at_node(displacement, n.node, contact.first.body->dimension()), n.normal, n.pressure, n.weight, static_cast<Status>(static_cast<int>(n.status)),
                             n.shear, contact.second.body ? contact.rows[k].gap : 0, n.gap, mesh::length(n.slip)});
  }
  find_sharp(contact, picture);
  return picture;
}

std::vector<double> contact_values(const ContactPicture& contact, FieldChoice field) {
  std::vector<double> out;
  if (field == FieldChoice::status) return out;
  for (const ContactNode& node : contact.nodes)
    out.push_back(field == FieldChoice::pressure ? node.pressure : field == FieldChoice::gap ? node.gap : node.status == Status::open ? NAN : node.slip);
  return out;
}

RigidPicture obstacle_picture(const Contact& contact, const scene::ContactResult& result, const Vec3& move, double factor,
                              double size) {
  RigidPicture picture;
  const std::vector<Vec3> at = seen_by_nodes(contact, result, move, factor);
  const std::vector<bool> faces = facing(contact);
  const bool any = std::find(faces.begin(), faces.end(), true) != faces.end();  // else a corner alone looks at it
  const double magnified = std::holds_alternative<contact::RigidPlane>(contact.shape) ? 1 : factor;
  std::vector<int> place(at.size(), -1);
  Vec3 outward{0, 0, 0};
  for (std::size_t k = 0; k < at.size(); ++k) {
    if ((any && !faces[k]) || magnified * contact.rows[k].gap > 0.25 * size) continue;
    outward = plus(outward, contact.rows[k].normal, 1);
    place[k] = static_cast<int>(picture.points.size()) / 3;
    picture.points.insert(picture.points.end(), at[k].begin(), at[k].end());
  }
  if (mesh::length(outward) > 0) outward = mesh::unit(outward);
  picture.into_solid = outward;
  if (contact.first.body->dimension() == 3)
    picture.triangles = triangles(contact, result, place);
  else
    picture.points = polyline(contact, result, at, place, outward, kBeyond * size);
  return picture;
}

void add_contacts(const Solution& s, const SceneOptions& options, const std::vector<Vec3>& moves, double size, ScenePicture& picture) {
  std::vector<std::pair<const Contact*, std::size_t>> drawn;
  for (const auto& contact : s.scene().contacts) {
    if (contact->kind != Contact::Kind::contact) continue;
    const scene::ContactResult result = s.contact(*contact);
    const int first = s.scene().index_of(contact->first.body.get());
    ContactPicture shown = contact_picture(*contact, result, s.displacement(first));
    if (of_contacts(options.field)) shown.values = contact_values(shown, options.field);
    if (options.explode > 0 && contact->second.body) picture.contacts.push_back(moved(other_side(shown), moves[s.scene().index_of(contact->second.body.get())]));
    picture.contacts.push_back(options.explode > 0 ? moved(std::move(shown), moves[first]) : std::move(shown));
    drawn.emplace_back(contact.get(), picture.contacts.size() - 1);
    if (!contact->second.body && options.obstacle) {
      RigidPicture obstacle = obstacle_picture(*contact, result, s.loading().move_of(s.scene().index_of(*contact)), picture.deformation, size);
      if (obstacle.points.size() < 6) continue;
      picture.obstacles.push_back(std::move(obstacle));
      picture.gaps_magnified |= picture.deformation != 1 && magnifies(*contact, result, size);
    }
  }
  if (s.scene().dimension() == 2) cover(s, drawn, picture.contacts);
}

}  // namespace dotyk::figure
