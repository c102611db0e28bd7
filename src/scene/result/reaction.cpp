#include <set>

#include "base/error.hpp"
#include "scene/result/solution.hpp"
#include "scene/model/support_rows.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;

/// Adds to `force` (node × dimension) what the row groups exert on a body: −Bᵀλ with all components,
/// also of nodes whose displacement is prescribed.
void add_interface_force(const Scene& scene, const Model& model, const algebra::Vector& lambda, int body,
                         std::vector<double>& force) {
  const int dim = scene.dimension();
  const auto push = [&](int node, const Point& direction, double amount) {
    for (int i = 0; i < dim; ++i) force[static_cast<std::size_t>(node) * dim + i] += amount * direction[i];
  };
  for (std::size_t c = 0; c < model.contact_row.size(); ++c) {
    const Contact& contact = *scene.contacts[c];
    const int first = scene.index_of(contact.first.body.get()), second = scene.index_of(contact.second.body.get());
    if (contact.kind == Contact::Kind::contact && (first == body || second == body)) {
      const std::vector<Point> pushed = model.contact_force(static_cast<int>(c), lambda);
      for (std::size_t k = 0; k < pushed.size(); ++k) {
        if (first == body)
          for (const contact::NodeWeight& own : contact.rows[k].own) push(own.node, pushed[k], own.weight);
        if (second != body) continue;
        for (const contact::NodeWeight& partner : contact.rows[k].partners) push(partner.node, pushed[k], -partner.weight);
      }
    }
    for (const auto& [k, direction, r] : model.glue_row[c]) {
      const contact::Tie& tie = contact.glued[k];
      if (first == body)
        for (const contact::NodeWeight& own : tie.own) push(own.node, direction, -own.weight * lambda[r]);
      if (second != body) continue;
      for (const contact::NodeWeight& partner : tie.partners) push(partner.node, direction, partner.weight * lambda[r]);
    }
  }
  for (std::size_t s = 0; s < model.support_row[body].size(); ++s)
    for (std::size_t k = 0; k < model.support_row[body][s].size(); ++k) {
      const LawSupport& support = model.bodies[body].laws[s];
      const Point pushed = law_force(support.nodes[k], model.support_row[body][s][k], lambda);
      for (const contact::NodeWeight& own : support.nodes[k].own) push(own.node, pushed, own.weight);
    }
  for (std::size_t k = 0; k < model.slide_row[body].size(); ++k) {
    const int r = model.slide_row[body][k];
    const SlideRow& slide = model.bodies[body].slides[k];
    if (r >= 0) push(slide.node, slide.normal, -lambda[r]);
  }
}

/// What all supports by laws on the part exert, loads included.
Point law_reaction(const Model& model, const algebra::Vector& lambda, int body, const PartMark& mark) {
  const Body& b = model.bodies[body];
  Point sum{0, 0, 0};
  for (std::size_t s = 0; s < b.laws.size(); ++s) {
    if (b.laws[s].part != mark) continue;
    for (std::size_t k = 0; k < b.laws[s].nodes.size(); ++k) {
      const Point force = law_force(b.laws[s].nodes[k], model.support_row[body][s][k], lambda);
      const Point load = law_load(b.laws[s], b.laws[s].nodes[k], b.dimension());
      for (int i = 0; i < 3; ++i) sum[i] += force[i] + load[i];
    }
  }
  return sum;
}

}  // namespace

Point Solution::reaction(const Part& part) const {
  const int index = scene_->index_of(part.body.get());
  if (index < 0) throw InputError("part '" + part.name + "' is not of the scene that was solved");
  const Body& body = this->body(index);
  const int dim = body.dimension();
  const PartMark mark = part.mark();
  // What supports must add to loads and contact to balance the inner forces.
  std::vector<double> missing =
      elasticity::internal_force(*body.mesh, body.material, body.facet_springs(), displacement_[index]);
  std::vector<double> other = body.force;
  add_interface_force(*scene_, model_, result_.state.lambda, index, other);
  Point sum = law_reaction(model_, result_.state.lambda, index, mark);
  std::set<std::size_t> counted;
  for (const Support& support : body.supports)
    for (std::size_t k = 0; k < support.nodes.size(); ++k)
      for (int i = 0; i < dim; ++i) {
        const std::size_t at = static_cast<std::size_t>(support.nodes[k]) * dim + i;
        if (!support.components[k][i] || !counted.insert(at).second || support.part != mark) continue;
        sum[i] += missing[at] - other[at];
      }
  for (std::size_t k = 0; k < body.slides.size(); ++k) {
    const int r = model_.slide_row[index][k];
    if (r < 0 || body.slides[k].part != mark) continue;
    for (int i = 0; i < dim; ++i) sum[i] -= result_.state.lambda[r] * body.slides[k].normal[i];
  }
  for (const SpringPatch& patch : body.springs) {
    if (patch.part != mark) continue;
    elasticity::for_each_facet_point(*body.mesh, patch.spring.facet, [&](const elasticity::FacetPoint& p) {
      for (int i = 0; i < dim; ++i)
        for (int a = 0; a < p.nodes; ++a)
          sum[i] -= patch.spring.stiffness[p.index][i] * p.measure * p.shape[a] *
                    displacement_[index][static_cast<std::size_t>(body.mesh->facet_node(patch.spring.facet, a)) * dim + i];
    });
  }
  return sum;
}

}  // namespace dotyk::scene
