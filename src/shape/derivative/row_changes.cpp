#include "shape/derivative/row_changes.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "contact/row_derivative.hpp"
#include "scene/model/free_jumps.hpp"
#include "scene/result/load_derivative.hpp"

namespace dotyk::shape {
namespace {

using contact::ContactRow;
using contact::RowDerivative;
using mesh::Point;
using mesh::dot;
using scene::Contact;

/// A contact with what moves its two sides.
struct Moving {
  const Contact& contact;
  int first, second;  ///< bodies; second is -1 against a rigid shape
  const std::vector<double>&V, &W;

  const mesh::Mesh& mesh() const { return *contact.first.body->mesh; }
  bool any() const {
    return scene::moving_facet(mesh(), contact.first.facets, V) || (second >= 0 && scene::moving_facet(*contact.second.body->mesh, contact.second.facets, W));
  }
  std::vector<RowDerivative> derivatives() const {
    if (second < 0) return contact::row_derivatives(mesh(), contact.first.facets, contact.rows, contact.shape, V);
    return contact::row_derivatives(contact.first.face(), contact.rows, V, contact.second.face(), W);
  }
};

Moving moving(const scene::Solution& solution, int index, const Velocities& velocities) {
  static const std::vector<double> rest;
  const Contact& contact = *solution.scene().contacts[static_cast<std::size_t>(index)];
  const int first = solution.scene().index_of(contact.first.body.get()), second = solution.scene().index_of(contact.second.body.get());
  return {contact, first, second, velocities[static_cast<std::size_t>(first)], second < 0 ? rest : velocities[static_cast<std::size_t>(second)]};
}

/// What overhangs the other part is left out where there is a common surface.
std::vector<double> weights(const Contact& contact, const std::vector<RowDerivative>& rows, const std::vector<double>& V) {
  std::vector<double> out;
  for (const RowDerivative& d : rows) out.push_back(d.weight);
  if (!contact.second.body) return out;
  const contact::Surface surface = scene::surface_of(contact);
  const std::vector<double> measures = contact::measures(surface), change = contact::measure_derivatives(surface, V);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (measures[k] > 0) out[k] = change[k];
  return out;
}

/// One contact's share.
class ContactChanges {
 public:
  ContactChanges(const scene::Solution& solution, int index, const Velocities& velocities, RowChanges& changes)
      : solution_(solution), model_(solution.model()), moving_(moving(solution, index, velocities)), contact_(*model_.contacts[static_cast<std::size_t>(index)]), index_(index),
        dim_(solution.scene().dimension()), first_(moving_.first), second_(moving_.second), changes_(changes) {}

  void add() {
    if (!moving_.any()) return;
    require_matching();
    if (contact_.kind == Contact::Kind::glue) return;
    require_nodal();
    require_unmeasured();
    derivatives_ = moving_.derivatives();
    const scene::FreeJumps jumps(solution_.scene(), model_.bodies, model_.numbering, contact_);
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) {
      free_.push_back(jumps.at(contact_.rows[k]));
      scene::hold_normal(free_[k], moving_.contact.rows[k], derivatives_[k].normal, derivatives_[k].gap);
    }
    for (std::size_t k = 0; k < contact_.rows.size(); ++k)
      if (const int r = model_.contact_row[index_][k]; r >= 0) turn(r, static_cast<int>(k), derivatives_[k].normal, derivatives_[k].gap);
    friction();
  }

 private:
  void require_matching() const {
    if (contact_.pairing != contact::Pairing::matching)
      throw InputError(contact_.name + " has nodes that do not match, and moves: how its rows, means over facets cut, change is not "
                                       "known; make it with matching nodes, or keep its nodes at rest");
  }

  void require_nodal() const {
    const bool plain = dim_ == 2 && contact_.friction == scene::Friction::Kind::none;  // p1_p0's rows are then the nodal ones
    if (contact_.discretisation.multipliers != contact::Multipliers::nodal && !plain)
      throw InputError(contact_.name + " has multipliers = \"P1-P0\" and moves: how its rows, integrals over facets and cells, change "
                                       "is not known; take \"nodal\", or keep its nodes at rest");
  }

  void require_unmeasured() const {
    using Kind = problem::SupportLaw::Kind;
    if (contact_.normal.kind != Kind::signorini || contact_.tangential.kind != Kind::free)
      throw InputError(contact_.name + " has laws per length or area and moves: how its nodes' shares change these is not known; take Signorini's law with "
                                       "given or Coulomb friction, or keep its nodes at rest");
  }

  Point displacement(int body, int node) const { return mesh::at_node(solution_.displacement(body), node, dim_); }

  /// u₁ − u₂ at a contact row, or less the rigid shape's displacement.
  Point jump(const ContactRow& row) const {
    return mesh::minus(displacement(first_, row.node), second_ < 0 ? model_.move[index_] : displacement(second_, row.partners.front().node));
  }

  /// Row r of B, at contact row k, changes its direction and gap.
  void turn(int r, int k, const Point& direction, double gap) {
    const ContactRow& row = contact_.rows[k];
    changes_.c[r] = gap - dot(direction, jump(row));
    const double lambda = solution_.result().state.lambda[r];
    for (int i = 0; i < dim_; ++i) {
      changes_.force[first_][static_cast<std::size_t>(row.node) * dim_ + i] += lambda * direction[i];
      if (second_ >= 0) changes_.force[second_][static_cast<std::size_t>(row.partners.front().node) * dim_ + i] -= lambda * direction[i];
    }
  }

  void friction() {
    if (contact_.friction == scene::Friction::Kind::none) return;
    const std::vector<double> weight = weights(contact_, derivatives_, moving_.V);
    for (const scene::FrictionRows& rows : model_.friction[index_]) {
      const int k = rows.cell.jumps.front().row;  // nodal: a cell is a node's surroundings
      for (int i = 0; i < rows.count; ++i)
        turn(rows.row[i], k, scene::free_tangent_derivative(free_[k], contact_.rows[k].normal, derivatives_[k].normal, rows.direction[i], dim_), 0);
      if (contact_.friction != scene::Friction::Kind::tresca || !std::isfinite(rows.cell.bound)) continue;
      for (const contact::Term& node : rows.cell.nodes)
        changes_.bound[rows.row[0]] += node.weight * contact_.friction_value[node.row] * weight[node.row];
    }
  }

  const scene::Solution& solution_;
  const scene::Model& model_;
  Moving moving_;
  const Contact& contact_;  ///< with the normals that supports say
  int index_, dim_, first_, second_;
  RowChanges& changes_;
  std::vector<RowDerivative> derivatives_;
  std::vector<Eigen::Matrix3d> free_;  ///< of the jump at each row
};

}  // namespace

RowChanges row_changes(const scene::Solution& solution, const Velocities& velocities) {
  RowChanges changes{algebra::Vector::Zero(solution.rows()), {}, algebra::Vector::Zero(solution.rows())};
  for (std::size_t b = 0; b < solution.scene().bodies.size(); ++b)
    changes.force.emplace_back(solution.displacement(static_cast<int>(b)).size(), 0.0);
  for (std::size_t c = 0; c < solution.scene().contacts.size(); ++c)
    ContactChanges(solution, static_cast<int>(c), velocities, changes).add();
  return changes;
}

std::vector<double> weight_changes(const scene::Solution& solution, int contact, const Velocities& velocities) {
  const Moving m = moving(solution, contact, velocities);
  if (!m.any()) return std::vector<double>(m.contact.rows.size(), 0.0);
  return weights(m.contact, m.derivatives(), m.V);
}

}  // namespace dotyk::shape
