#include "scene/result/load_derivative.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "elasticity/shape_derivative.hpp"

namespace dotyk::scene {
namespace {

using mesh::Facet;
using mesh::Point;
using mesh::dot;
using mesh::length;

/// A body's velocity, what is rounding left out.
class Velocity {
 public:
  Velocity(const Body& body, const std::vector<double>& V) : body_(body), mesh_(*body.mesh), V_(V) {
    for (const double v : V) greatest_ = std::max(greatest_, std::abs(v));
  }

  /// Of a facet's nodes the greatest component.
  double of(Facet f) const {
    double most = 0;
    for (int k = 0; k < mesh_.topology().nodes_per_facet; ++k)
      for (int i = 0; i < mesh_.dimension(); ++i)
        most = std::max(most, std::abs(V_[static_cast<std::size_t>(mesh_.facet_node(f, k)) * mesh_.dimension() + i]));
    return most;
  }

  void require_rest(const std::vector<Facet>& facets, const std::string& part, const std::string& why) const {
    for (const Facet f : facets)
      if (of(f) > 1e-12 * greatest_)
        throw InputError(text("'", body_.name, "' ", part, ": ", why, ", and its nodes move at ",
                              point_text(mesh_.facet_centre(f).data(), mesh_.dimension())));
  }

  /// The normal of each side, by Σ of its facets' area vectors.
  void require_straight(const std::vector<Facet>& facets, const std::string& part) const {
    for (const contact::NodeSide& side : contact::sides(mesh_, facets)) {
      Point change{0, 0, 0};
      double scale = 0;
      for (const int k : side.facets) {
        const Point d = mesh::facet_area_derivative(mesh_, V_, facets[k]);
        for (int i = 0; i < 3; ++i) change[i] += d[i];
        scale += of(facets[k]) * (mesh_.dimension() == 2 ? 1 : std::sqrt(length(mesh_.facet_area_vector(facets[k]))));
      }
      const double along = dot(change, side.normal);
      for (int i = 0; i < 3; ++i) change[i] -= along * side.normal[i];
      if (length(change) > 1e-9 * scale)
        throw InputError(text("'", body_.name, "' ", part, " slides, and its nodes move so that its normal turns at ",
                              point_text(mesh_.node(side.node), mesh_.dimension()),
                              ", of which there is no derivative; keep them, move them along the part, or fix it"));
    }
  }

 private:
  const Body& body_;
  const mesh::Mesh& mesh_;
  const std::vector<double>& V_;
  double greatest_ = 0;
};

void require_body(const Body& body, const Velocity& velocity) {
  for (const Support& support : body.supports)
    if (support.kind == SupportKind::slide) velocity.require_straight(support.facets, support.part.name);
  for (std::size_t k = 0; k < body.slides.size(); ++k)
    if (k == 0 || body.slides[k].facets != body.slides[k - 1].facets) velocity.require_straight(*body.slides[k].facets, body.slides[k].part.name);
  for (const LawSupport& law : body.laws)
    velocity.require_rest(law.facets, law.part.name, "its support by laws has no derivative; keep its nodes, or fix it or give it springs");
}

}  // namespace

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
    require_body(*scene.bodies[b], Velocity(*scene.bodies[b], V[b]));
  }
  for (const auto& contact : scene.contacts) {
    const int first = scene.index_of(contact->first.body.get());
    if (contact->kind == Contact::Kind::glue || contact->second.body || V[first].empty()) continue;
    if (std::holds_alternative<contact::RigidGap>(contact->shape))
      Velocity(*scene.bodies[first], V[first])
          .require_rest(contact->first.facets, contact->first.name,
                        "its contact with a rigid gap, a function of the place, has no derivative; keep its nodes, or take a rigid plane or ball");
  }
}

}  // namespace dotyk::scene
