#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/solution.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;

Point at_node(const std::vector<double>& values, int node, int dim) {
  Point p{0, 0, 0};
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(node) * dim, dim, p.begin());
  return p;
}

/// Shear on the first body, and whether the node sticks or slips.
void add_friction(const TangentRows& tangent, const solver::Result& result, ContactNode& node) {
  if (tangent.count == 0) return;
  bool slips = false;
  for (int i = 0; i < tangent.count; ++i) {
    const int r = tangent.row[i];
    slips = slips || (!result.slipping.empty() && result.slipping[r]);
    for (int k = 0; k < 3; ++k) node.shear[k] -= result.state.lambda[r] * tangent.direction[i][k] / node.weight;
  }
  if (node.status == problem::Status::closed)
    node.status = slips ? problem::Status::slip : problem::Status::stick;
}

}  // namespace

ContactResult Solution::contact(const Contact& contact) const {
  int index = -1;
  for (std::size_t k = 0; k < scene_->contacts.size(); ++k)
    if (scene_->contacts[k].get() == &contact) index = static_cast<int>(k);
  if (index < 0)
    throw InputError(text("this contact (", contact.name, ") is not part of the scene that was solved"));
  if (contact.kind == Contact::Kind::glue)
    throw InputError(text(contact.name, " is a glue; only contacts have a pressure and a status"));
  const int first = scene_->index_of(contact.first.body.get());
  const int second = scene_->index_of(contact.second.body.get());
  const int dim = scene_->dimension();
  ContactResult result;
  for (std::size_t k = 0; k < contact.rows.size(); ++k) {
    const contact::ContactRow& row = contact.rows[k];
    const int r = model_.contact_row[index][k];
    ContactNode node;
    node.node = row.node;
    node.x = scene_->bodies[first]->mesh->point(row.node);
    node.displacement = at_node(displacement_[first], row.node, dim);
    node.normal = row.normal;
    node.weight = row.weight;
    const Point other = second >= 0 ? at_node(displacement_[second], row.partner, dim) : Point{0, 0, 0};
    Point jump;
    double normal_jump = 0;
    for (int i = 0; i < 3; ++i) {
      jump[i] = node.displacement[i] - other[i];
      normal_jump += row.normal[i] * jump[i];
    }
    node.gap = row.gap - normal_jump;
    for (int i = 0; i < 3; ++i) node.slip[i] = jump[i] - normal_jump * row.normal[i];
    if (r >= 0) {
      node.force = result_.state.lambda[r];
      node.pressure = row.weight > 0 ? node.force / row.weight : 0;
      if (active(r)) node.status = problem::Status::closed;
      add_friction(model_.tangent_row[index][k], result_, node);
    }
    for (int i = 0; i < 3; ++i) result.force[i] += node.weight * node.shear[i] - node.force * row.normal[i];
    if (node.status != problem::Status::open) result.area += row.weight;
    switch (node.status) {
      case problem::Status::open: ++result.open; break;
      case problem::Status::closed: ++result.closed; break;
      case problem::Status::stick: ++result.stick; break;
      case problem::Status::slip: ++result.slip; break;
    }
    result.max_pressure = std::max(result.max_pressure, node.pressure);
    result.nodes.push_back(node);
  }
  return result;
}

}  // namespace dotyk::scene
