#include "scene/result/load_derivative.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "elasticity/shape_derivative.hpp"

namespace dotyk::scene {
namespace {

using mesh::Facet;
using mesh::Point;
using mesh::dot;
using mesh::length;

/// Of a facet's nodes the greatest component of their velocity.
double speed(const mesh::Mesh& mesh, Facet f, const std::vector<double>& V) {
  double most = 0;
  for (int k = 0; k < mesh.topology().nodes_per_facet; ++k)
    for (int i = 0; i < mesh.dimension(); ++i)
      most = std::max(most, std::abs(V[static_cast<std::size_t>(mesh.facet_node(f, k)) * mesh.dimension() + i]));
  return most;
}

void require_rest(const Body& body, const std::vector<double>& V, const std::vector<Facet>& facets, const std::string& part, const std::string& why) {
  if (const auto f = moving_facet(*body.mesh, facets, V))
    throw InputError(text("'", body.name, "' ", part, ": ", why, ", and its nodes move at ", point_text(body.mesh->facet_centre(*f).data(), body.dimension())));
}

/// The normal of each side, by Σ of its facets' area vectors.
void require_straight(const Body& body, const std::vector<double>& V, const std::vector<Facet>& facets, const std::string& part) {
  const mesh::Mesh& mesh = *body.mesh;
  for (const contact::NodeSide& side : contact::sides(mesh, facets)) {
    Point change{0, 0, 0};
    double scale = 0;
    for (const int k : side.facets) {
      const Point d = mesh::facet_area_derivative(mesh, V, facets[k]);
      for (int i = 0; i < 3; ++i) change[i] += d[i];
      scale += speed(mesh, facets[k], V) * (mesh.dimension() == 2 ? 1 : std::sqrt(length(mesh.facet_area_vector(facets[k]))));
    }
    const double along = dot(change, side.normal);
    for (int i = 0; i < 3; ++i) change[i] -= along * side.normal[i];
    if (length(change) > 1e-9 * scale)
      throw InputError(text("'", body.name, "' ", part, " slides, and its nodes move so that its normal turns at ",
                            point_text(mesh.node(side.node), mesh.dimension()),
                            ", of which there is no derivative; keep them, move them along the part, or fix it"));
  }
}

void require_body(const Body& body, const std::vector<double>& V) {
  for (const Support& support : body.supports)
    if (support.kind == SupportKind::slide) require_straight(body, V, support.facets, support.part.name);
  for (std::size_t k = 0; k < body.slides.size(); ++k)
    if (k == 0 || body.slides[k].facets != body.slides[k - 1].facets) require_straight(body, V, *body.slides[k].facets, body.slides[k].part.name);
  for (const LawSupport& law : body.laws)
    require_rest(body, V, law.facets, law.part.name, "its support by laws has no derivative; keep its nodes, or fix it or give it springs");
}

}  // namespace

std::optional<Facet> moving_facet(const mesh::Mesh& mesh, const std::vector<Facet>& facets, const std::vector<double>& V) {
  double greatest = 0;
  for (const double v : V) greatest = std::max(greatest, std::abs(v));
  if (greatest == 0) return std::nullopt;
  const auto found = std::find_if(facets.begin(), facets.end(), [&](Facet f) { return speed(mesh, f, V) > 1e-12 * greatest; });
  return found == facets.end() ? std::nullopt : std::optional(*found);
}

std::vector<double> load_derivative(const Body& body, const Loading& loading, const std::vector<double>& V) {
  std::vector<double> nodal(body.mesh->coordinates.size(), 0.0);
  const int dim = body.dimension();
  if (body.volume_load)
    elasticity::add_body_force_derivative(*body.mesh, [&](const elasticity::CellPoint& p) {
      Point f = body.volume_load->at(p.cell, p.index, dim);
      for (double& v : f) v *= loading.of("");
      return f;
    }, V, nodal);
  for (const FacetLoad& load : body.facet_loads) {
    const double factor = loading.of(load.load_case);
    for (std::size_t k = 0; k < load.facets.size(); ++k)
      if (load.pressure)
        elasticity::add_pressure_derivative(*body.mesh, {load.facets[k]}, [&](const auto& p) { return factor * load.pressure_at(k, p); }, V, nodal);
      else
        elasticity::add_traction_derivative(*body.mesh, {load.facets[k]}, [&](const auto& p) {
          Point t = load.traction(k, p, dim);
          for (double& v : t) v *= factor;
          return t;
        }, V, nodal);
  }
  return nodal;
}

std::vector<double> internal_force_derivative(const Body& body, const std::vector<double>& u, const std::vector<double>& V) {
  std::vector<double> nodal = elasticity::internal_force_derivative(*body.mesh, body.material, u, V);
  elasticity::add_spring_force_derivative(*body.mesh, body.facet_springs(), u, V, nodal);
  return nodal;
}

void require_differentiable(const Scene& scene, const std::vector<std::vector<double>>& V) {
  if (V.size() != scene.bodies.size())
    throw InputError(text("the scene has ", scene.bodies.size(), " bodies; velocities are given for ", V.size()));
  for (std::size_t b = 0; b < V.size(); ++b) {
    if (V[b].empty()) continue;
    if (V[b].size() != scene.bodies[b]->mesh->coordinates.size())
      throw InputError(text("'", scene.bodies[b]->name, "' has ", scene.bodies[b]->mesh->coordinates.size(), " coordinates; ", V[b].size(),
                            " velocities are given for them"));
    if (const mesh::ElementTopology& t = scene.bodies[b]->mesh->topology(); t.order == 2)
      throw InputError(text("'", scene.bodies[b]->name, "' is of ", t.name, "; derivatives by the nodes' places are of bodies of P1 or Q1"));
    require_body(*scene.bodies[b], V[b]);
  }
  for (const auto& contact : scene.contacts) {
    const int first = scene.index_of(contact->first.body.get());
    if (contact->kind == Contact::Kind::glue || contact->second.body || V[first].empty()) continue;
    if (std::holds_alternative<contact::RigidGap>(contact->shape))
      require_rest(*scene.bodies[first], V[first], contact->first.facets, contact->first.name,
                   "its contact with a rigid gap, a function of the place, has no derivative; keep its nodes, or take a rigid plane or ball");
  }
}

}  // namespace dotyk::scene
