#include "scene/free_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "contact/row_derivative.hpp"
#include "contact/tangents.hpp"
#include "scene/contact_rows.hpp"

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
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(sum);
  const Vector3d in = eigen.eigenvalues().unaryExpr([](double v) { return v > kHeld ? 1.0 : 0.0; });
  return cleaned(eigen.eigenvectors() * in.asDiagonal() * eigen.eigenvectors().transpose());
}

int dimension_of(const Matrix3d& V) { return static_cast<int>(std::lround(V.trace())); }

}  // namespace

FreeJumps::FreeJumps(const Scene& scene, const std::vector<Body>& bodies, const std::vector<elasticity::Numbering>& numbering,
                     const Contact& contact)
    : contact_(contact), second_(nullptr), dim_(scene.dimension()) {
  const auto slides = [&](std::size_t body) {
    Slides of_node;
    for (const SlideRow& slide : bodies[body].slides) of_node[slide.node].push_back(slide.normal);
    return of_node;
  };
  const int first = scene.index_of(contact.first.body.get()), second = scene.index_of(contact.second.body.get());
  first_ = &numbering[static_cast<std::size_t>(first)];
  first_slides_ = slides(static_cast<std::size_t>(first));
  if (second < 0) return;
  second_ = &numbering[static_cast<std::size_t>(second)];
  second_slides_ = slides(static_cast<std::size_t>(second));
}

Matrix3d FreeJumps::of_node(const elasticity::Numbering& numbering, const Slides& slides, int node) const {
  Matrix3d P = Matrix3d::Zero();
  for (int i = 0; i < dim_; ++i) P(i, i) = numbering.unknown[static_cast<std::size_t>(node) * dim_ + i] >= 0;
  const auto found = slides.find(node);
  if (found == slides.end()) return P;
  for (const Point& normal : found->second) {
    const Vector3d e = P * vector(normal);
    if (e.norm() > kHeld) P -= e * e.transpose() / e.squaredNorm();
  }
  return cleaned(P);
}

Matrix3d FreeJumps::at(const contact::ContactRow& row) const {
  Matrix3d sum = Matrix3d::Zero();
  for (const contact::NodeWeight& own : row.own) sum += of_node(*first_, first_slides_, own.node);
  if (second_ && !row.partners.empty()) sum += of_node(*second_, second_slides_, facing(contact_, row.node, row.partners));
  return onto_range(sum);
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
  std::erase_if(all, [&](const Point& t) { return (V * vector(t) - vector(t)).norm() > kHeld || std::abs(vector(t).dot(n)) > kHeld; });
  if (all.size() == 1) return all;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(V);  // the first vector is across V
  const Vector3d t = n.cross(eigen.eigenvectors().col(0).eval());
  if (t.norm() < kHeld) return {};
  return {point(t.normalized())};
}

Point free_tangent_derivative(const Matrix3d& V, const Point& normal, const Point& dn, const Point& tangent, int dimension) {
  if (dimension_of(V) == dimension) {
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
