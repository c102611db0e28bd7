#include "shape/derivative/boundary_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "contact/row_derivative.hpp"
#include "scene/model/free_jumps.hpp"
#include "scene/result/load_derivative.hpp"
#include "shape/design/bspline.hpp"

namespace dotyk::shape {
namespace {

using algebra::DenseMatrix;
using mesh::Point;
using mesh::length;
using contact::ContactRow;
using contact::RowDerivative;
using mesh::dot;
using scene::Contact;

[[noreturn]] void not_one(const scene::Part& part, const std::string& why) {
  throw InputError(text(part.label(), " ", why, "; a part that B-splines move must be one chain of edges"));
}

constexpr int kMostPoints = 4096;

std::vector<int> nodes_of(const scene::Part& part) {
  require_first_order(*part.body);
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<int> nodes;
  for (const mesh::Facet f : part.facets)
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) nodes.push_back(mesh.facet_node(f, k));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::size_t place(const std::vector<int>& nodes, int node) {
  return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
}

std::vector<Point> normals(const scene::Part& part, const std::vector<int>& nodes) {
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<Point> sum(nodes.size(), Point{0, 0, 0});
  std::vector<double> size(nodes.size(), 0.0);
  for (const mesh::Facet f : part.facets) {
    const Point n = mesh.facet_area_vector(f);
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) {
      const std::size_t at = place(nodes, mesh.facet_node(f, k));
      for (int i = 0; i < 3; ++i) sum[at][i] += n[i];
      size[at] += length(n);
    }
  }
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double total = length(sum[a]);
    if (!(total > 1e-6 * size[a]))
      throw InputError(text(part.label(), " has no normal at ", point_text(mesh.node(nodes[a]), mesh.dimension()), "; give a direction"));
    for (double& x : sum[a]) x /= total;
  }
  return sum;
}

DenseMatrix along_chain(const scene::Part& part, const std::vector<int>& nodes, const ControlPoints& points) {
  const Chain chain = chain_of(part);
  const BSplines splines(points.degree, points.count[0], chain.closed ? BSplines::Ends::periodic : BSplines::Ends::open);
  DenseMatrix weight(nodes.size(), splines.count());
  for (std::size_t k = 0; k < chain.nodes.size(); ++k)
    weight.row(static_cast<Eigen::Index>(place(nodes, chain.nodes[k]))) = splines.values(chain.length[k] / chain.total).transpose();
  return weight;
}

DenseMatrix over_surface(const scene::Part& part, const std::vector<int>& nodes, const ControlPoints& points) {
  const mesh::Mesh& mesh = *part.body->mesh;
  mesh::Box box;
  for (const int node : nodes) box.add(mesh.point(node));
  int axis[3] = {0, 1, 2};
  std::stable_sort(axis, axis + 3, [&](int i, int j) { return box.extent(i) > box.extent(j); });
  const BSplines first(points.degree, points.count[0]), second(points.degree, points.count[1]);
  DenseMatrix weight(nodes.size(), first.count() * second.count());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double* x = mesh.node(nodes[a]);
    const auto values = [&](const BSplines& along, int i) { return along.values((x[i] - box.low[i]) / box.extent(i)); };
    const DenseMatrix product = values(first, axis[0]) * values(second, axis[1]).transpose();
    weight.row(static_cast<Eigen::Index>(a)) = Eigen::Map<const Eigen::RowVectorXd>(product.data(), product.size());
  }
  return weight;
}

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
    const bool plain = dim_ == 2 && !contact_.tangential->rubs();  // p1_p0's rows are then the nodal ones
    if (contact_.discretisation.multipliers != contact::Multipliers::nodal && !plain)
      throw InputError(contact_.name + " has multipliers = \"P1-P0\" and moves: how its rows, integrals over facets and cells, change "
                                       "is not known; take \"nodal\", or keep its nodes at rest");
  }

  void require_unmeasured() const {
    if (!contact_.normal->stop() || contact_.tangential->elastic())
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
    if (!contact_.tangential->rubs()) return;
    const std::vector<double> weight = weights(contact_, derivatives_, moving_.V);
    for (const scene::FrictionRows& rows : model_.friction[index_]) {
      const int k = rows.cell.jumps.front().row;  // nodal: a cell is a node's surroundings
      for (int i = 0; i < rows.count; ++i)
        turn(rows.row[i], k, scene::free_tangent_derivative(free_[k], contact_.rows[k].normal, derivatives_[k].normal, rows.direction[i], dim_), 0);
      if (!contact_.tangential->tresca() || !std::isfinite(rows.cell.bound)) continue;
      for (const contact::Term& node : rows.cell.nodes)
        changes_.bound[rows.row[0]] += node.weight * contact_.tangential[node.row].numbers[0] * weight[node.row];
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

Chain chain_of(const scene::Part& part) {
  const mesh::Mesh& mesh = *part.body->mesh;
  if (mesh.dimension() != 2) throw InputError(text(part.label(), " is a surface in space, not a chain of edges"));
  std::map<int, int> next, previous;
  for (const mesh::Facet f : part.facets) {
    const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
    if (!next.emplace(a, b).second || !previous.emplace(b, a).second)
      not_one(part, text("branches at ", point_text(mesh.node(next.count(a) ? a : b), 2)));
  }
  int first = mesh.facet_node(part.facets.front(), 0), begins = 0;
  for (const auto& [a, b] : next)
    if (!previous.count(a)) first = a, ++begins;
  if (begins > 1) not_one(part, text("falls into ", begins, " pieces"));
  Chain chain{{first}, {0.0}, 0, begins == 0};
  for (int at = first; next.count(at);) {
    const int to = next[at];
    chain.total += plane_distance(mesh.node(at), mesh.node(to));
    if (to == first) break;
    chain.nodes.push_back(to);
    chain.length.push_back(chain.total);
    at = to;
  }
  if (chain.nodes.size() + (chain.closed ? 0 : std::size_t(-1)) != next.size()) not_one(part, "falls into pieces");
  return chain;
}

void require_first_order(const scene::Body& body) {
  if (body.mesh->topology().order == 2)
    throw InputError(text("'", body.name, "' is of ", body.mesh->topology().name, "; designs are of bodies of P1 or Q1"));
}

Point BoundaryMotion::velocity(std::size_t node, int variable) const {
  Point v = direction[node];
  for (double& x : v) x *= weight(static_cast<Eigen::Index>(node), variable);
  return v;
}

BoundaryMotion bspline_motion(const scene::Part& part, const ControlPoints& points) {
  BoundaryMotion motion{part, nodes_of(part), {}, {}};
  const int dimension = part.body->dimension();
  const long long asked = points.count[0] * (dimension == 2 ? 1LL : points.count[1]);
  if (asked > kMostPoints) throw InputError(text(asked, " control points of ", part.label(), "; at most ", kMostPoints, " are taken"));
  motion.weight = dimension == 2 ? along_chain(part, motion.nodes, points) : over_surface(part, motion.nodes, points);
  for (Eigen::Index j = 0; j < motion.weight.cols(); ++j)
    if ((motion.weight.col(j).array() == 0).all())
      throw InputError(text("control point ", j + 1, " of ", asked, " moves none of the ", motion.nodes.size(), " nodes of ", part.label(), "; take fewer, or a finer mesh"));
  if (!points.direction) {
    motion.direction = normals(part, motion.nodes);
    return motion;
  }
  const Point d = *points.direction;
  if (!std::isfinite(length(d)) || length(d) == 0 || (dimension == 2 && d[2] != 0))
    throw InputError(text("the direction in which control points of ", part.label(), " move is ", point_text(d.data(), dimension), "; it must be a vector of the ",
                          dimension == 2 ? "plane" : "space", " other than zero"));
  motion.direction.assign(motion.nodes.size(), d);
  return motion;
}

BoundaryMotion combined(BoundaryMotion motion, const DenseMatrix& T) {
  if (T.rows() != motion.weight.cols() || T.cols() == 0)
    throw InputError(text("variables made of ", T.rows(), " control points; ", motion.part.label(), " has ", motion.weight.cols()));
  motion.weight = DenseMatrix(motion.weight * T);
  return motion;
}

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
