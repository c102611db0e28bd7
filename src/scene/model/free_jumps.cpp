#include "scene/model/free_jumps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "contact/row_derivative.hpp"
#include "contact/contact_row.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }
Point point(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// Left of an axis that other axes span is rounding: such entries are exactly 0 or 1.
Matrix3d cleaned(Matrix3d P) {
  return P.unaryExpr([](double v) { return std::abs(v) < 1e-14 ? 0 : std::abs(v - 1) < 1e-14 ? 1 : v; });
}

/// Onto the range of a sum of projections.
Matrix3d onto_range(const Matrix3d& sum) {
  if (sum.isDiagonal(0)) return Matrix3d(sum.diagonal().unaryExpr([](double v) { return v > kHeld ? 1.0 : 0.0; }).asDiagonal());
  const algebra::Eigenpairs3 eigen = algebra::eigenpairs3(sum);
  const Vector3d in = eigen.values.unaryExpr([](double v) { return v > kHeld ? 1.0 : 0.0; });
  return cleaned(eigen.vectors * in.asDiagonal() * eigen.vectors.transpose());
}

/// The weight, relative to the row's own, below which a partner is there by rounding.
constexpr double kNoWeight = 1e-9;
/// Distance between planes that are one, relative to a body's size.
constexpr double kInPlane = 1e-6;

/// The nearest of a node's partners. Where nodes do not match and supports hold both, as on a plane of symmetry, there is no row
/// (as between matching nodes), though partners further in may move: multipliers there would hold the second part alone.
int facing(const Contact& contact, int node, const std::vector<contact::NodeWeight>& partners) {
  if (partners.size() == 1) return partners.front().node;
  const Point x = contact.first.body->mesh->point(node);
  int nearest = -1;
  double least = INFINITY;
  for (const contact::NodeWeight& partner : partners) {
    const double distance = mesh::length(mesh::minus(x, contact.second.body->mesh->point(partner.node)));
    if (distance < least) least = distance, nearest = partner.node;
  }
  return nearest;
}

int dimension_of(const Matrix3d& V) { return static_cast<int>(std::lround(V.trace())); }

}  // namespace

FreeJumps::FreeJumps(const Scene& scene, const std::vector<Body>& bodies, const std::vector<elasticity::Numbering>& numbering,
                     const Contact& contact)
    : contact_(contact), second_{nullptr, {}}, dim_(scene.dimension()) {
  const auto side = [&](const Part& part) {
    const auto body = static_cast<std::size_t>(scene.index_of(part.body.get()));
    return side_of(bodies[body], numbering[body]);
  };
  first_ = side(contact.first);
  if (contact.second.body) second_ = side(contact.second);
}

FreeJumps::Side FreeJumps::side_of(const Body& body, const elasticity::Numbering& numbering) {
    Side result{&numbering, {}};
  for (const SlideRow& slide : body.slides) result.conditions[slide.node].push_back({slide.normal, 0});
  for (const LawSupport& law : body.laws)
    for (std::size_t k = 0; k < law.nodes.size(); ++k) {
      const contact::NodeSide& side = law.nodes[k];
      if (side.own.size() > 1) continue;
      if (law.normal->prescribes) result.conditions[side.node].push_back({side.normal, -law.normal[k].displacement()});
      if (law.tangential->prescribes)
        for (const Point& t : contact::tangents(side.normal, body.dimension())) result.conditions[side.node].push_back({t, law.tangential[k].displacement()});
    }
  return result;
}

FreeJumps::Node FreeJumps::of_node(const Side& side, int node) const {
  Node result{Matrix3d::Zero(), Vector3d::Zero()};
  Matrix3d& P = result.free;
  for (int i = 0; i < dim_; ++i) {
    const std::size_t at = static_cast<std::size_t>(node) * dim_ + i;
    P(i, i) = side.numbering->unknown[at] >= 0;
    if (side.numbering->unknown[at] < 0) result.given[i] = side.numbering->value(at);
  }
  const auto found = side.conditions.find(node);
  if (found == side.conditions.end()) return result;
  for (const Condition& c : found->second) {
    const Vector3d e = P * vector(c.direction);
    if (e.norm() <= kHeld) continue;
    result.given += (c.value - vector(c.direction).dot(result.given)) / e.squaredNorm() * e;
    P -= e * e.transpose() / e.squaredNorm();
  }
  P = cleaned(P);
  return result;
}

Matrix3d FreeJumps::at(const contact::ContactRow& row) const {
  if (second_.numbering && row.partners.size() > 1)
    if (const auto plane = plane_of_symmetry(row.node, row.own, row.partners, &row.normal)) return *plane;
  Matrix3d sum = Matrix3d::Zero();
  for (const contact::NodeWeight& own : row.own) sum += of_node(first_, own.node).free;
  if (second_.numbering)
    for (const contact::NodeWeight& partner : row.partners)
      if (std::abs(partner.weight) > kNoWeight || row.partners.size() == 1) sum += of_node(second_, partner.node).free;
  return onto_range(sum);
}

std::vector<Point> FreeJumps::at(const contact::Tie& tie) const {
  std::optional<Matrix3d> V;
  if (tie.own.size() == 1) V = plane_of_symmetry(tie.node, tie.own, tie.partners, nullptr);
  if (!V) {
    Matrix3d sum = of_node(second_, facing(contact_, tie.node, tie.partners)).free;
    for (const contact::NodeWeight& own : tie.own) sum += of_node(first_, own.node).free;
    V = onto_range(sum);
  }
  std::vector<Point> axes;
  if (V->isDiagonal(0)) {  // of one partner, an axis that supports hold on both sides has a row without unknowns, which compares what they prescribe
    for (int i = 0; i < dim_; ++i)
      if ((*V)(i, i) > 0 || tie.partners.size() == 1) axes.push_back(point(Vector3d::Unit(i)));
    return axes;
  }
  const algebra::Eigenpairs3 eigen = algebra::eigenpairs3(*V);
  for (int i = 0; i < 3; ++i)
    if (eigen.values[i] > 0.5) axes.push_back(point(eigen.vectors.col(i)));
  return axes;
}

double FreeJumps::torn(const contact::Tie& tie) const {
  const Node own = of_node(first_, tie.node);
  double nearest = INFINITY;
  std::vector<Vector3d> given;  // of partners held in the same directions
  for (const contact::NodeWeight& partner : tie.partners) {
    const Node other = of_node(second_, partner.node);
    const Matrix3d across = Matrix3d::Identity() - onto_range(own.free + other.free);
    if (std::lround(across.trace()) == 3 - dim_) continue;
    given.push_back(across * other.given);
    nearest = std::min(nearest, (across * own.given - given.back()).norm());
  }
  double spread = 0;  // values may vary along the parts
  for (const Vector3d& a : given)
    for (const Vector3d& b : given) spread = std::max(spread, (a - b).norm());
  return given.empty() || nearest <= spread ? 0 : nearest;
}

bool FreeJumps::stay(const Side& side, const mesh::Mesh& mesh, const std::vector<contact::NodeWeight>& nodes, const Point& in, const Matrix3d& V) const {
  return std::all_of(nodes.begin(), nodes.end(), [&](const contact::NodeWeight& n) {
    const Vector3d apart = vector(mesh.point(n.node)) - vector(in);
    const Matrix3d free = of_node(side, n.node).free;
    return std::abs(n.weight) <= kNoWeight || (apart - V * apart).norm() > kInPlane * mesh.size() || (free - V * free).norm() <= kHeld;
  });
}

std::optional<Matrix3d> FreeJumps::plane_of_symmetry(int node, const std::vector<contact::NodeWeight>& own, const std::vector<contact::NodeWeight>& partners,
                                                     const Point* normal) const {
  const mesh::Mesh &mesh = *contact_.first.body->mesh, &other = *contact_.second.body->mesh;
  const Matrix3d free = of_node(first_, node).free;
  if (dimension_of(free) == dim_ || mesh.topology().order == 2) return std::nullopt;
  const Point x = mesh.point(node);
  std::optional<Matrix3d> least;
  for (const contact::NodeWeight& partner : partners) {
    const Matrix3d V = onto_range(free + of_node(second_, partner.node).free);
    if (dimension_of(V) == dim_ || (least && dimension_of(V) >= dimension_of(*least)) || (normal && (V * vector(*normal)).norm() <= kHeld)) continue;
    const Vector3d apart = vector(x) - vector(other.point(partner.node));
    if ((apart - V * apart).norm() > kInPlane * mesh.size()) continue;
    if (stay(first_, mesh, own, x, V) && stay(second_, other, partners, x, V)) least = V;
  }
  return least;
}

std::optional<double> FreeJumps::given(const contact::ContactRow& row) const {
  double sum = 0;
  const auto add = [&](const Side& side, int node, double weight) {
    const Node n = of_node(side, node);
    sum += weight * n.given.dot(vector(row.normal));
    return (n.free * vector(row.normal)).norm() <= kHeld;
  };
  for (const contact::NodeWeight& own : row.own)
    if (!add(first_, own.node, own.weight)) return std::nullopt;
  for (const contact::NodeWeight& partner : row.partners)
    if (!add(second_, partner.node, -partner.weight)) return std::nullopt;
  return sum;
}

std::vector<Point> free_tangents(const Matrix3d& V, const Point& normal, int dimension) {
  std::vector<Point> all = contact::tangents(normal, dimension);
  if (dimension_of(V) == dimension) return all;
  if (dimension == 2 || dimension_of(V) < 2) {
    // A plane has one tangent; V, a line or nothing, is spanned by the normal's projection, or has no normal row.
    std::erase_if(all, [&](const Point& t) { return dimension_of(V) == 0 || (V * vector(normal)).norm() > kHeld || (V * vector(t)).norm() < kHeld; });
    return all;
  }
  const Vector3d n = V * vector(normal);
  if (n.norm() < kHeld) return all;  // the normal is held: V is the plane of the tangents
  std::erase_if(all, [&](const Point& t) { return (V * vector(t) - vector(t)).norm() > kHeld || std::abs(vector(t).dot(n)) > kHeld; });
  if (all.size() == 1) return all;
  const algebra::Eigenpairs3 eigen = algebra::eigenpairs3(V);  // the first vector is across V
  const Vector3d t = n.cross(eigen.vectors.col(0).eval());
  if (t.norm() < kHeld) return {};
  return {point(t.normalized())};
}

Point free_tangent_derivative(const Matrix3d& V, const Point& normal, const Point& dn, const Point& tangent, int dimension) {
  if (dimension_of(V) == dimension || (V * vector(normal)).norm() < kHeld) {
    const std::vector<Point> t = contact::tangents(normal, dimension), dt = contact::tangent_derivatives(normal, dn, dimension);
    const auto which = std::find(t.begin(), t.end(), tangent) - t.begin();
    return dt.at(static_cast<std::size_t>(which));
  }
  // V is a plane, in which n′ and the tangent turn together.
  const Vector3d n = V * vector(normal), d = V * vector(dn);
  return point(-(vector(tangent).dot(d) / n.squaredNorm()) * n);
}

namespace {

/// Does V say the row's normal?
bool decides(const Matrix3d& V, const contact::ContactRow& row) {
  const Vector3d n = vector(row.normal), off = n - V * n;
  return off.norm() > kHeld && off.norm() <= row.turn && off.norm() < 0.5;
}

}  // namespace

std::shared_ptr<const Contact> with_held_normals(const std::shared_ptr<const Contact>& contact, const FreeJumps& jumps) {
  std::shared_ptr<Contact> held;
  for (std::size_t k = 0; k < contact->rows.size(); ++k) {
    const contact::ContactRow& row = contact->rows[k];
    if (!(row.turn > kHeld)) continue;
    const Matrix3d V = jumps.at(row);
    if (!decides(V, row)) continue;
    if (!held) {
      held = std::make_shared<Contact>(*contact);
      held->origin = contact->origin ? contact->origin : contact;
    }
    const Vector3d n = V * vector(row.normal);
    held->rows[k].normal = point(n.normalized());
    held->rows[k].gap = (row.gap - row.added) / n.norm() + row.added;
  }
  return held ? held : contact;
}

void hold_normal(const Matrix3d& V, const contact::ContactRow& row, Point& dnormal, double& dgap) {
  if (!decides(V, row)) return;
  const Vector3d n = V * vector(row.normal), dn = V * vector(dnormal);
  const double size = n.norm(), along = n.dot(dn) / size;
  dgap = dgap / size - (row.gap - row.added) * along / (size * size);
  dnormal = point((dn - along / size * n) / size);
}

}  // namespace dotyk::scene
