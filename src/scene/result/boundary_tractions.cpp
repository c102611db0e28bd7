#include "scene/result/boundary_tractions.hpp"

#include <algorithm>

namespace dotyk::scene {

using elasticity::FacetTraction;
using mesh::Facet;
using mesh::Point;
using mesh::dot;

Boundary::Boundary(const Body& body, const elasticity::Numbering& numbering, const std::vector<double>& u) : mesh_(*body.mesh) {
  for (const Facet f : mesh::boundary(mesh_)) all_.push_back({f});
  for (const LoadArrow& load : load_arrows(body))
    if (FacetTraction* at = find(load.facet))
      for (Point& t : at->traction)
        for (int i = 0; i < 3; ++i) t[i] += load.value[i];
  for (const SpringPatch& patch : body.springs) add_spring(patch.spring, u);
  forget_held(body, numbering);
}

FacetTraction* Boundary::find(Facet f) {
  const auto found = std::lower_bound(all_.begin(), all_.end(), f, [](const FacetTraction& at, Facet wanted) { return at.facet < wanted; });
  return found == all_.end() || found->facet != f ? nullptr : &*found;
}

/// −k u at the nodes, k the facet's mean.
void Boundary::add_spring(const elasticity::FacetSpring& spring, const std::vector<double>& u) {
  FacetTraction* at = find(spring.facet);
  if (!at || spring.stiffness.empty()) return;
  for (int k = 0; k < corners(); ++k)
    for (int i = 0; i < mesh_.dimension(); ++i)
      for (const auto& stiffness : spring.stiffness)
        at->traction[k][i] -= stiffness[i] / static_cast<double>(spring.stiffness.size()) *
                              u[static_cast<std::size_t>(mesh_.facet_node(spring.facet, k)) * mesh_.dimension() + i];
}

/// Directions in which all nodes of a facet are held.
void Boundary::forget_held(const Body& body, const elasticity::Numbering& numbering) {
  std::map<int, std::vector<Point>> slides;
  for (const SlideRow& slide : body.slides) slides[slide.node].push_back(slide.normal);
  for (FacetTraction& facet : all_) {
    for (int i = 0; i < mesh_.dimension(); ++i) {
      bool held = true;
      for (int k = 0; k < corners(); ++k)
        held = held && numbering.unknown[static_cast<std::size_t>(mesh_.facet_node(facet.facet, k)) * mesh_.dimension() + i] < 0;
      Point axis{0, 0, 0};
      axis[i] = 1;
      if (held) facet.forget(axis);
    }
    if (slides.empty()) continue;
    const Point n = mesh::unit(mesh_.facet_area_vector(facet.facet));
    bool slides_all = true;
    for (int k = 0; k < corners(); ++k) {
      const auto found = slides.find(mesh_.facet_node(facet.facet, k));
      slides_all = slides_all && found != slides.end() &&
                   std::any_of(found->second.begin(), found->second.end(), [&](const Point& m) { return dot(m, n) > 0.9; });
    }
    if (slides_all) facet.forget(n);
  }
}

namespace {

/// Traction on the first body at a contact node.
Point traction(const ContactNode& node) {
  return mesh::minus(node.shear, mesh::times(node.pressure, node.normal));
}

/// The opposite tractions on the second body's facets all of whose nodes are partners, on the side that looks their way.
void add_second_nodes(const Contact& contact, const ContactResult& result, Boundary& boundary) {
  const mesh::Mesh& mesh = *contact.second.body->mesh;
  const bool itself = contact.first.body == contact.second.body;
  std::map<int, std::vector<std::size_t>> rows;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) rows[contact.rows[k].partners.front().node].push_back(k);
  for (const Facet f : contact.second.facets) {
    FacetTraction* at = boundary.find(f);
    const Point n = mesh.facet_area_vector(f);
    std::array<Point, 4> opposite{};
    bool all = at != nullptr, any = false;
    for (int a = 0; all && a < mesh.topology().nodes_per_facet; ++a) {
      const auto found = rows.find(mesh.facet_node(f, a));
      if (itself && found == rows.end()) continue;  // the tip of a crack
      all = found != rows.end();
      if (!all) break;
      any = true;
      const std::size_t row = *std::min_element(found->second.begin(), found->second.end(), [&](std::size_t i, std::size_t j) {
        return dot(contact.rows[i].normal, n) < dot(contact.rows[j].normal, n);
      });
      opposite[a] = mesh::times(-1, traction(result.nodes[row]));
    }
    if (!all || !any) continue;
    at->contact = true;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) at->traction[a][i] += opposite[a][i];
  }
}

/// The same where nodes do not match: a node of the second body has the mean of the tractions that reach it, weighted with
/// the forces' shares. Facets that they reach in part have a traction of which nothing is known, and so have all where the feet
/// of single nodes are all that is reached.
void add_second_means(const Contact& contact, const ContactResult& result, Boundary& boundary) {
  const mesh::Mesh& mesh = *contact.second.body->mesh;
  std::map<int, std::pair<Point, double>> reached;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) {
    const Point t = traction(result.nodes[k]);
    for (const contact::NodeWeight& partner : contact.rows[k].partners) {
      const double share = partner.weight * contact.rows[k].weight;
      auto& [sum, measure] = reached[partner.node];
      for (int i = 0; i < 3; ++i) sum[i] -= share * t[i];
      measure += share;
    }
  }
  // Nodes reached by less than their ∫φ have facets that are reached in part.
  std::map<int, double> whole;
  for (const Facet f : contact.second.facets)
    elasticity::for_each_facet_point(mesh, f, [&](const elasticity::FacetPoint& p) {
      for (int a = 0; a < p.nodes; ++a) whole[mesh.facet_node(f, a)] += p.measure * p.shape[a];
    });
  for (const Facet f : contact.second.facets) {
    FacetTraction* at = boundary.find(f);
    bool all = contact.pairing == contact::Pairing::mortar, any = false;
    for (int a = 0; a < mesh.topology().nodes_per_facet; ++a) {
      const auto found = reached.find(mesh.facet_node(f, a));
      any = any || found != reached.end();
      all = all && found != reached.end() && found->second.second > (1 - 1e-6) * whole[mesh.facet_node(f, a)];
    }
    if (!at || !any) continue;
    at->contact = true;
    for (int a = 0; all && a < mesh.topology().nodes_per_facet; ++a) {
      const auto& [sum, measure] = reached.at(mesh.facet_node(f, a));
      for (int i = 0; i < 3; ++i) at->traction[a][i] += sum[i] / measure;
    }
    if (!all) at->known = {};
  }
}

}  // namespace

void add_first(const contact::Surface& surface, const ContactResult& result, Boundary& boundary) {
  for (const contact::SurfaceFacet& f : surface.facets) {
    FacetTraction* at = boundary.find(f.facet);
    if (!at) continue;
    at->contact = true;
    for (int a = 0; a < f.corners; ++a)
      for (int i = 0; i < 3 && f.row[a] >= 0; ++i) at->traction[a][i] += traction(result.nodes[f.row[a]])[i];
  }
}

void add_second(const Contact& contact, const ContactResult& result, Boundary& boundary) {
  if (contact.pairing == contact::Pairing::matching)
    add_second_nodes(contact, result, boundary);
  else
    add_second_means(contact, result, boundary);
}

}  // namespace dotyk::scene
