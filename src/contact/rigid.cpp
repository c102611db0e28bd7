#include "contact/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/corner_means.hpp"

namespace dotyk::contact {
namespace {

using mesh::Point;

/// Normal (towards the shape) and gap of a node at x.
struct Distance {
  Point normal;
  double gap;
};

Distance distance(const RigidGap& shape, const Point& x) { return {shape.normal, shape.gap(x)}; }

Distance distance(const RigidPlane& shape, const Point& x) {
  return {mesh::times(-1, shape.normal), mesh::dot(mesh::minus(x, shape.point), shape.normal)};
}

Distance distance(const RigidBall& shape, const Point& x) {
  Point n = mesh::minus(shape.center, x);
  const double r = mesh::length(n);
  if (!(r > 1e-9 * shape.radius))
    throw InputError("the centre of the rigid ball lies on the contact part; move the ball out of the body");
  for (double& v : n) v /= r;
  return {n, r - shape.radius};
}

}  // namespace

const char* name(const RigidShape& shape) {
  static const char* names[] = {"rigid gap", "rigid plane", "rigid ball"};
  return names[shape.index()];
}

namespace {

/// Of cosines: normals that are perpendicular but for rounding do not face away.
constexpr double kAway = 1e-6;

/// Where a part is next to a shape.
struct Nearest {
  double gap = INFINITY;
  double facing = 1;  ///< cosine between the part's outward normal there and the way to the shape
  Point at{0, 0, 0};
};

/// Does the body reach further towards the plane than `from`? Then a part that faces away there lies on the body's other side; else
/// it is a corner of the body, which may touch.
bool reaches_beyond(const mesh::Mesh& mesh, const RigidPlane& plane, const Point& from, double rounding) {
  for (int i = 0; i < mesh.node_count(); ++i)
    if (mesh::dot(mesh::minus(mesh.point(i), from), plane.normal) < -rounding) return true;
  return false;
}

/// A shape behind the part would be held off from inside the body, its pressure pulling the part outwards: a ball inside the body, a
/// half-space that fills it, a gap measured inwards.
void refuse_behind(const mesh::Mesh& mesh, const RigidShape& shape, const Nearest& nearest, double most_facing, double rounding) {
  const std::string place = point_text(nearest.at.data(), mesh.dimension());
  if (std::holds_alternative<RigidGap>(shape) && most_facing < -kAway)
    throw InputError(text("the rigid gap lies behind the part: its normal points into the body, at ", place,
                          " as everywhere on the part; it must point out of the body, towards the obstacle"));
  if (std::holds_alternative<RigidBall>(shape) && nearest.facing < 0)
    throw InputError(text("the rigid ball lies behind the part: at ", place,
                          ", where it is nearest, its centre is on the body's side; move it out of the body"));
  const auto* plane = std::get_if<RigidPlane>(&shape);
  if (plane && nearest.facing < -kAway && reaches_beyond(mesh, *plane, nearest.at, rounding))
    throw InputError(text("the rigid plane lies behind the part: at ", place,
                          ", where it is nearest, the part faces away from it; its normal must point out of the rigid "
                          "half-space, towards the body, and the part be on the side of the body that it meets"));
}

/// The rows; `added(k, x)` is added to the gap of the part's node k, at x.
template <class Added>
std::vector<ContactRow> make_rows(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const RigidShape& shape,
                                  const Added& added, bool interference) {
  const bool geometric = !std::holds_alternative<RigidGap>(shape);
  const double rounding = 1e-9 * mesh.size();
  double deepest = 0, most_facing = -1;
  Point where{0, 0, 0};
  Nearest nearest;
  struct At {
    Distance distance;
    double added;
  };
  std::map<int, At> at;
  for (const NodeSide& side : nodes(mesh, facets)) {
    const Point x = mesh.point(side.node);
    Distance d = std::visit([&](const auto& s) { return distance(s, x); }, shape);
    const double more = added(at.size(), x);
    d.gap += more;
    if (!std::isfinite(d.gap))
      throw InputError(text("the gap is ", d.gap, " at ", point_text(x.data(), mesh.dimension()),
                            "; it must be a finite number"));
    if (d.gap < deepest) deepest = d.gap, where = x;
    const double facing = mesh::dot(d.normal, side.normal);
    most_facing = std::max(most_facing, facing);
    const bool level = std::abs(d.gap - nearest.gap) <= rounding;  // of those equally near one that faces the shape counts
    if (level ? facing > nearest.facing : d.gap < nearest.gap) nearest = {d.gap, facing, x};
    at.emplace(side.node, At{d, more});
  }
  if (geometric && !interference && deepest < -rounding)
    throw InputError(text("the ", name(shape), " penetrates the part by ", -deepest, " at ",
                          point_text(where.data(), mesh.dimension()),
                          " before any load; move it, or say interference = true if the overlap is meant",
                          std::holds_alternative<RigidPlane>(shape) && nearest.facing < 0
                              ? " (its normal must point out of the rigid half-space, towards the body)"
                              : ""));
  refuse_behind(mesh, shape, nearest, most_facing, rounding);
  std::vector<ContactRow> rows;
  for (NodeSide& side : corner_nodes(mesh, facets)) {
    ContactRow row{side.node, std::move(side.own), {}, at.at(side.node).distance.normal, 0, side.weight, std::move(side.facets), 0};
    double least = INFINITY;
    for (const NodeWeight& own : row.own) {
      const At& here = at.at(own.node);
      row.gap += own.weight * here.distance.gap;
      row.added += own.weight * here.added;
      least = std::min(least, here.distance.gap);
    }
    if (least >= 0) row.gap = std::max(row.gap, 0.0);  // a dual hat is negative in places: a mean of gaps may be
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<ContactRow> against(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                const RigidShape& shape, const elasticity::ScalarField& added,
                                bool interference) {
  return make_rows(mesh, facets, shape, [&](std::size_t, const Point& x) { return added ? added(x) : 0; }, interference);
}

std::vector<ContactRow> moved_rows(const std::vector<ContactRow>& rows, const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                   const RigidShape& shape, bool interference) {
  return make_rows(mesh, facets, shape, [&](std::size_t k, const Point&) { return rows.at(k).added; }, interference);
}

}  // namespace dotyk::contact
