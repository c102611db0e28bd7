#include "contact/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "contact/frame.hpp"

namespace dotyk::contact {
namespace {

using mesh::Point;
using mesh::dot;
using mesh::minus;

/// The way (unit, towards the shape) and the distance of a node at x from where the shape is nearest; of a RigidGap what it says.
struct Distance {
  Point inward;
  double gap;
};

Distance distance(const RigidGap& shape, const Point& x) { return {shape.normal, shape.gap(x)}; }

Distance distance(const RigidPlane& shape, const Point& x) {
  return {mesh::times(-1, shape.normal), dot(minus(x, shape.point), shape.normal)};
}

Distance distance(const RigidBall& shape, const Point& x) {
  Point n = minus(shape.center, x);
  const double r = mesh::length(n);
  if (!(r > 1e-9 * shape.radius))
    throw InputError("the centre of the rigid ball lies on the contact part; move the ball out of the body");
  for (double& v : n) v /= r;
  return {n, r - shape.radius};
}

constexpr double kSteep = 0.8 * 0.8;  ///< (ρ/R)² up to which s is the circle's

/// s(ρ²) of a unit ball, and its derivative.
struct Height {
  double s, ds;
};

Height height(double q) {
  if (q <= kSteep) {
    const double s = std::sqrt(1 - q);
    return {s, -0.5 / s};
  }
  const double decay = 0.5 / (1 - kSteep), s = std::sqrt(1 - kSteep) * std::exp(-decay * (q - kSteep));
  return {s, -decay * s};
}

/// What the formula is made of.
struct Parts {
  Parts(const RigidBall& ball, const Point& x, const Point& n) : w(minus(ball.center, x)), c(dot(w, n)), far(mesh::length(w)) {
    const Point off = minus(w, mesh::times(c, n));
    of_unit = height(dot(off, off) / (ball.radius * ball.radius));
    below = c + ball.radius * of_unit.s;
  }
  Point w;
  double c, far, below;
  Height of_unit;
};

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
    if (dot(minus(mesh.point(i), from), plane.normal) < -rounding) return true;
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

/// Makes the frames of rows; against a ball by the part's normals and curvatures, see rigid.hpp.
class RigidFrames {
 public:
  RigidFrames(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const RigidShape& shape)
      : mesh_(mesh), ball_(std::get_if<RigidBall>(&shape)) {
    if (!ball_) return;
    const Face part{mesh, facets, ""};
    curvatures_.emplace(part);
    smooth_ = smooth_sides(part);
  }

  Frame of(const NodeSide& side, const Point& inward) const {
    const Frame shapes{inward, kSecondDecides, 0};
    if (!ball_ || !smooth_.contains(side.node) || dot(side.normal, inward) < kAcross) return shapes;
    const double flat = kFlat / mesh_.size(), distance = mesh::length(minus(ball_->center, mesh_.point(side.node)));
    if (1 / distance < flat) return shapes;
    const Eigen::Matrix3d K1 = curvatures_->at(side);
    if (K1.norm() < flat) return {side.normal, kFirstDecides, turn(side)};
    const Eigen::Map<const Eigen::Vector3d> e(inward.data());
    const Eigen::Matrix3d K2 = (Eigen::Matrix3d::Identity() - e * e.transpose()) / distance;
    Frame frame = frame_between(side.normal, K1, inward, K2, flat, mesh_.dimension());
    frame.turn = turn(side);
    return frame;
  }
  /// Of a row whose M is known.
  Frame moved(const NodeSide& side, const Point& inward, const std::array<Point, 3>& mix) const {
    return {mixed_normal(side.normal, inward, mix), mix, mix == kSecondDecides ? 0 : turn(side)};
  }

 private:
  double turn(const NodeSide& side) const { return curvatures_->at(side).norm() * curvatures_->width(side); }

  static constexpr double kAcross = 0.5;  ///< cosine, as between two parts: second_facets.hpp
  const mesh::Mesh& mesh_;
  const RigidBall* ball_;
  std::optional<Curvatures> curvatures_;
  std::unordered_map<int, NodeSide> smooth_;
};

/// The gap of a node at x in a row with this frame.
double gap_along(const RigidShape& shape, const Point& x, const Frame& frame, const Distance& distance) {
  const auto* ball = std::get_if<RigidBall>(&shape);
  return ball && frame.mix != kSecondDecides ? ball_gap(*ball, x, frame.normal) : distance.gap;
}

/// The rows. `before`: those that they were before nodes moved, whose M and `added` stay; null: made for the first time, with `added(x)`.
std::vector<ContactRow> make_rows(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const RigidShape& shape,
                                  const elasticity::ScalarField& added, const std::vector<ContactRow>* before, bool interference) {
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
    const double more = before ? before->at(at.size()).added : added ? added(x) : 0, gap = d.gap + more;
    if (!std::isfinite(gap))
      throw InputError(text("the gap is ", gap, " at ", point_text(x.data(), mesh.dimension()),
                            "; it must be a finite number"));
    if (gap < deepest) deepest = gap, where = x;
    const double facing = dot(d.inward, side.normal);
    most_facing = std::max(most_facing, facing);
    const bool level = std::abs(gap - nearest.gap) <= rounding;  // of those equally near one that faces the shape counts
    if (level ? facing > nearest.facing : gap < nearest.gap) nearest = {gap, facing, x};
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
  const RigidFrames frames(mesh, facets, shape);
  std::vector<ContactRow> rows;
  for (NodeSide& side : corner_nodes(mesh, facets)) {
    const Point& inward = at.at(side.node).distance.inward;
    const Frame frame = before ? frames.moved(side, inward, before->at(rows.size()).mix) : frames.of(side, inward);
    ContactRow row{.node = side.node, .own = std::move(side.own), .normal = frame.normal, .weight = side.weight, .facets = std::move(side.facets),
                   .mix = frame.mix, .turn = frame.turn};
    double least = INFINITY;
    for (const NodeWeight& own : row.own) {
      const At& here = at.at(own.node);
      const double gap = gap_along(shape, mesh.point(own.node), frame, here.distance) + here.added;
      row.gap += own.weight * gap;
      row.added += own.weight * here.added;
      least = std::min(least, gap);
    }
    if (least >= 0) row.gap = std::max(row.gap, 0.0);  // a dual hat is negative in places: a mean of gaps may be
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

double ball_gap(const RigidBall& ball, const Point& x, const Point& n) {
  const Parts p(ball, x, n);
  return p.c > 0 ? (p.far - ball.radius) * (p.far + ball.radius) / p.below : p.far - ball.radius;
}

double ball_gap_derivative(const RigidBall& ball, const Point& x, const Point& n, const Point& v, const Point& dn) {
  const Parts p(ball, x, n);
  const double dsquare = -2 * dot(p.w, v), dc = dot(p.w, dn) - dot(v, n);
  if (!(p.c > 0)) return dsquare / (2 * p.far);
  const double gap = (p.far - ball.radius) * (p.far + ball.radius) / p.below;
  return (dsquare - gap * (dc + p.of_unit.ds / ball.radius * (dsquare - 2 * p.c * dc))) / p.below;
}

const char* name(const RigidShape& shape) {
  static const char* names[] = {"rigid gap", "rigid plane", "rigid ball"};
  return names[shape.index()];
}

std::vector<ContactRow> against(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                const RigidShape& shape, const elasticity::ScalarField& added,
                                bool interference) {
  return make_rows(mesh, facets, shape, added, nullptr, interference);
}

std::vector<ContactRow> moved_rows(const std::vector<ContactRow>& rows, const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                   const RigidShape& shape, bool interference) {
  return make_rows(mesh, facets, shape, {}, &rows, interference);
}

}  // namespace dotyk::contact
