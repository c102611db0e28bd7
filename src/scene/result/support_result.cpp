#include <algorithm>
#include <functional>
#include <set>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "scene/result/solution.hpp"
#include "scene/model/row_builder.hpp"

namespace dotyk::scene {
using mesh::Point;
using mesh::dot;
using problem::Status;

namespace {

/// The force on the body at a node of the laws that have rows, −λ along each row's direction.
Point law_force(const contact::NodeSide& side, const SupportRows& rows, const algebra::Vector& lambda) {
  Point force{0, 0, 0};
  const auto push = [&](int row, const Point& direction) {
    if (row >= 0)
      for (int i = 0; i < 3; ++i) force[i] -= lambda[row] * direction[i];
  };
  push(rows.normal, side.normal);
  for (int i = 0; i < rows.count; ++i) push(rows.row[i], rows.direction[i]);
  return force;
}

}  // namespace

SupportResult Solution::support(const Part& part) const {
  const int index = scene_->index_of(part.body.get());
  if (index < 0) throw InputError("part '" + part.name + "' is not of the scene that was solved");
  const Body& body = this->body(index);
  const PartMark mark = part.mark();
  const auto found = std::find_if(body.laws.begin(), body.laws.end(), [&](const LawSupport& l) { return l.part == mark; });
  if (found == body.laws.end()) {
    std::vector<std::string> all;
    for (const LawSupport& l : body.laws) all.push_back(l.part.name);
    throw InputError(text("part ", part.label(), " had no support by laws when it was solved; ",
                          all.empty() ? "none of the body's has" : "those that have: " + listed(all)));
  }
  const auto& rows = model_.support_row[index][static_cast<std::size_t>(found - body.laws.begin())];
  SupportResult result;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const SupportNode node = support_node(*found, k, rows[k], index);
    for (int i = 0; i < 3; ++i) result.force[i] += node.weight * (node.shear[i] - node.pressure * node.normal[i]);
    result.add(node.status, node.weight, node.pressure);
    result.broken += node.broken;
    result.tangential_stick += node.tangential == Status::stick;
    result.tangential_slip += node.tangential == Status::slip;
    for (int i = 0; i < rows[k].count; ++i) result.dissipated += dissipated_[rows[k].row[i]];
    result.nodes.push_back(node);
  }
  return result;
}

SupportNode Solution::support_node(const LawSupport& support, std::size_t k, const SupportRows& rows, int index) const {
  const contact::NodeSide& side = support.nodes[k];
  const Body& body = this->body(index);
  const algebra::Vector& lambda = result_.state.lambda;
  SupportNode node{side.node, body.mesh->point(side.node), side.normal, side.weight};
  const Point u = contact::mean(side.own, displacement(index), body.dimension());
  node.away = -dot(u, side.normal);
  const Point load = law_load(support, k, body.dimension()), force = law_force(side, rows, lambda);
  for (int i = 0; i < 3; ++i) node.slip[i] = u[i] + node.away * side.normal[i];
  const Point sum = mesh::plus(load, force);
  node.pressure = -dot(sum, side.normal) / side.weight;
  for (int i = 0; i < 3; ++i) node.shear[i] = (sum[i] + node.pressure * side.weight * side.normal[i]) / side.weight;
  node.broken = support.breaks(k);
  if (rows.normal >= 0 || support.normal->load)
    node.status = problem::status_of(*support.normal.operator->(), rows.normal >= 0 && active(rows.normal), node.pressure != 0);
  if (rows.count == 0 && !support.tangential->load) return node;
  const bool rubs = support.tangential->rubs();
  const bool pulled = support.tangential->follows && node.pressure < 0;  // slides freely
  const auto slips = [&](int r) { return pulled || (rubs ? !result_.slipping.empty() && result_.slipping[r] : !active(r)); };
  node.tangential = problem::status_of(*support.tangential.operator->(), std::none_of(rows.row, rows.row + rows.count, slips), true);
  return node;
}

Point Solution::reaction(const Part& part) const {
  const int index = scene_->index_of(part.body.get());
  if (index < 0) throw InputError("part '" + part.name + "' is not of the scene that was solved");
  const Body& body = this->body(index);
  const int dim = body.dimension();
  const PartMark mark = part.mark();
  // What supports must add to loads and contact to balance the inner forces.
  std::vector<double> missing =
      elasticity::internal_force(*body.mesh, body.material, body.facet_springs(), displacement(index));
  std::vector<double> other = body.force;
  other.resize(missing.size());  // zeros where the body has no loads
  if (body.unrefined) std::ranges::transform(volume_forces(body), other, other.begin(), std::plus());
  for (const HeldEntry& entry : model_.held)
    if (entry.body == index) other[entry.component] -= entry.value * result_.state.lambda[entry.row];
  Point sum{0, 0, 0};
  for (std::size_t s = 0; s < body.laws.size(); ++s)
    for (std::size_t k = 0; k < body.laws[s].nodes.size() && body.laws[s].part == mark; ++k)
      sum = mesh::plus(sum, mesh::plus(law_force(body.laws[s].nodes[k], model_.support_row[index][s][k], result_.state.lambda),
                                       law_load(body.laws[s], k, dim)));
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
    sum = mesh::minus(sum, mesh::times(result_.state.lambda[r], body.slides[k].normal));
  }
  for (const SpringPatch& patch : body.springs) {
    if (patch.part != mark) continue;
    elasticity::for_each_facet_point(*body.mesh, patch.spring.facet, [&](const elasticity::FacetPoint& p) {
      for (int i = 0; i < dim; ++i)
        for (int a = 0; a < p.nodes; ++a)
          sum[i] -= patch.spring.stiffness[p.index][i] * p.measure * p.shape[a] *
                    displacement(index)[static_cast<std::size_t>(body.mesh->facet_node(patch.spring.facet, a)) * dim + i];
    });
  }
  return sum;
}

std::string describe(const SupportResult& r, int dimension) {
  std::string out = text("force ", point_text(r.force.data(), dimension), ", ");
  if (r.stick + r.slip > 0) out += text(r.stick, " stick, ", r.slip, " slip, ");
  if (r.closed > 0 || r.stick + r.slip == 0) out += text(r.closed, " closed, ");
  out += text(r.open, " open, ");
  if (r.tangential_stick + r.tangential_slip > 0) out += text("tangents ", r.tangential_stick, " stick, ", r.tangential_slip, " slip, ");
  if (r.broken > 0) out += text(r.broken, " broken, ");
  return out + text("greatest pressure ", r.max_pressure, r.dissipated > 0 ? text(", dissipated ", r.dissipated) : "");
}

}  // namespace dotyk::scene
