#include "shape/row_changes.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "contact/row_derivative.hpp"
#include "contact/tangents.hpp"

namespace dotyk::shape {
namespace {

using contact::ContactRow;
using contact::RowDerivative;
using mesh::Point;
using scene::Contact;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// One contact's share.
class ContactChanges {
 public:
  ContactChanges(const scene::Solution& solution, int index, const Velocities& velocities, RowChanges& changes)
      : solution_(solution), model_(solution.model()), contact_(*solution.scene().contacts[index]), index_(index),
        dim_(solution.scene().dimension()), first_(solution.scene().index_of(contact_.first.body.get())),
        second_(solution.scene().index_of(contact_.second.body.get())), V_(velocities[first_]),
        W_(second_ < 0 ? none_ : velocities[second_]), changes_(changes) {}

  void add() {
    if (contact_.kind == Contact::Kind::glue || !moves()) return;
    require_nodal();
    derivatives_ = second_ < 0 ? contact::row_derivatives(mesh(first_), contact_.first.facets, contact_.rows, contact_.shape, V_)
                               : contact::row_derivatives(mesh(first_), contact_.first.facets, contact_.rows, V_, mesh(second_), W_);
    for (std::size_t k = 0; k < contact_.rows.size(); ++k)
      if (const int r = model_.contact_row[index_][k]; r >= 0) turn(r, static_cast<int>(k), derivatives_[k].normal, derivatives_[k].gap);
    friction();
  }

 private:
  const mesh::Mesh& mesh(int body) const { return *solution_.body(body).mesh; }

  /// Beyond rounding of V's greatest.
  static bool moves(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<double>& V) {
    double greatest = 0, here = 0;
    for (const double v : V) greatest = std::max(greatest, std::abs(v));
    if (greatest == 0) return false;
    for (const mesh::Facet f : facets)
      for (int a = 0; a < mesh.topology().nodes_per_facet; ++a)
        for (int i = 0; i < mesh.dimension(); ++i)
          here = std::max(here, std::abs(V[static_cast<std::size_t>(mesh.facet_node(f, a)) * mesh.dimension() + i]));
    return here > 1e-12 * greatest;
  }
  bool moves() const {
    return moves(mesh(first_), contact_.first.facets, V_) || (second_ >= 0 && moves(mesh(second_), contact_.second.facets, W_));
  }

  void require_nodal() const {
    const bool plain = dim_ == 2 && contact_.friction == scene::Friction::Kind::none;  // p1_p0's rows are then the nodal ones
    if (contact_.discretisation.multipliers != contact::Multipliers::nodal && !plain)
      throw InputError(contact_.name + " has multipliers = \"P1-P0\" and moves: how its rows, integrals over facets and cells, change "
                                       "is not known; take \"nodal\", or keep its nodes at rest");
  }

  Point displacement(int body, int node) const {
    Point u{0, 0, 0};
    for (int i = 0; i < dim_; ++i) u[i] = solution_.displacement(body)[static_cast<std::size_t>(node) * dim_ + i];
    return u;
  }

  /// u₁ − u₂ at a contact row, or less the rigid shape's displacement.
  Point jump(const ContactRow& row) const {
    Point j = displacement(first_, row.node);
    const Point other = second_ < 0 ? model_.move[index_] : displacement(second_, row.partner);
    for (int i = 0; i < 3; ++i) j[i] -= other[i];
    return j;
  }

  /// Row r of B, at contact row k, changes its direction and gap.
  void turn(int r, int k, const Point& direction, double gap) {
    const ContactRow& row = contact_.rows[k];
    changes_.c[r] = gap - dot(direction, jump(row));
    const double lambda = solution_.result().state.lambda[r];
    for (int i = 0; i < dim_; ++i) {
      changes_.force[first_][static_cast<std::size_t>(row.node) * dim_ + i] += lambda * direction[i];
      if (second_ >= 0) changes_.force[second_][static_cast<std::size_t>(row.partner) * dim_ + i] -= lambda * direction[i];
    }
  }

  void friction() {
    if (contact_.friction == scene::Friction::Kind::none) return;
    const std::vector<double> weight = weights();
    for (const scene::FrictionRows& rows : model_.friction[index_]) {
      const int k = rows.cell.jumps.front().row;  // nodal: a cell is a node's surroundings
      const auto t = contact::tangents(contact_.rows[k].normal, dim_);
      const auto dt = contact::tangent_derivatives(contact_.rows[k].normal, derivatives_[k].normal, dim_);
      for (int i = 0; i < rows.count; ++i) {
        const auto which = std::find(t.begin(), t.end(), rows.direction[i]) - t.begin();
        turn(rows.row[i], k, dt.at(static_cast<std::size_t>(which)), 0);
      }
      if (contact_.friction == scene::Friction::Kind::tresca && std::isfinite(contact_.friction_value[k]))
        changes_.bound[rows.row[0]] = contact_.friction_value[k] * weight[k];
    }
  }

  /// Of the rows' weights: against a rigid shape all facets count, else those of the common surface.
  std::vector<double> weights() const {
    std::vector<double> out;
    for (const RowDerivative& d : derivatives_) out.push_back(d.weight);
    if (second_ < 0) return out;
    const contact::Surface surface = scene::surface_of(contact_);
    const std::vector<double> measures = contact::measures(surface), change = contact::measure_derivatives(surface, V_);
    for (std::size_t k = 0; k < out.size(); ++k)
      if (measures[k] > 0) out[k] = change[k];
    return out;
  }

  inline static const std::vector<double> none_;
  const scene::Solution& solution_;
  const scene::Model& model_;
  const Contact& contact_;
  int index_, dim_, first_, second_;
  const std::vector<double>&V_, &W_;
  RowChanges& changes_;
  std::vector<RowDerivative> derivatives_;
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

}  // namespace dotyk::shape
