#include "figure/scene/scene_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dotyk::figure {

namespace {

void add_clipped(Bounds& to, Point p, Point q, const Bounds& box) {
  if (!crop(p, q, {box.left, box.bottom, box.right, box.top})) return;
  to.add(p);
  to.add(q);
}

// What keeps its size in pixels, at the present scale, with origin (0, 0).
void add_symbols(Bounds& bounds, const Stage& stage) {
  const ScenePicture& p = stage.picture;
  if (stage.strips() || stage.arrows())
    for (const ContactPicture& contact : p.contacts)
      for (const ContactNode& node : contact.nodes) {
        if (!(node.pressure > 0) || !(stage.greatest_pressure > 0)) continue;
        const Point at = stage.view.flat(stage.deformed(node.position, node.displacement)), n = stage.view.direction(node.normal);
        const double length = stage.strip_height() * node.pressure / stage.greatest_pressure;
        bounds.add({at.x + n.x * length, at.y + n.y * length});
      }
  if (stage.plane && stage.greatest_shear > 0)
    for (const ContactPicture& contact : p.contacts)
      for (const ContactNode& node : contact.nodes)
        if (dot(node.shear, node.shear) > 0)
          for (const Point& end : shear_arrow(stage, node)) bounds.add(end);
  if ((stage.strips() || stage.arrows()) && inset_width(stage) == 0)
    for (const ContactPicture& contact : p.contacts)
      if (const std::optional<PeakLabel> label = peak_label(stage, contact)) {
        bounds.add(Point{label->box.left, label->box.bottom});
        bounds.add(Point{label->box.right, label->box.top});
      }
  if (stage.plane)
    for (const SupportSymbol& s : p.supports) {
      const Point at = stage.view.flat(stage.deformed(s.position, s.displacement)), n = stage.view.direction(s.normal);
      const double r = 1.35 * support_size * stage.em;
      bounds.add({at.x + n.x * r, at.y + n.y * r});
    }
  const double greatest = greatest_load(p);
  for (const LoadArrow& load : p.loads)
    for (const Point& end : load_arrow(stage, load, greatest)) bounds.add(end);
  if (stage.added.bounds) stage.added.bounds(stage, bounds);
  if (stage.plane)
    for (const RigidPicture& rigid : p.obstacles) {
      if (rigid.closed) continue;
      const Point d = stage.view.direction(rigid.into_solid);
      const double depth = hatch_depth * stage.em;
      Bounds inside = bounds;
      for (std::size_t i = 0; i + 1 < rigid.points.size() / 3; ++i) {
        Bounds piece;
        add_clipped(piece, stage.view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], 0}),
                    stage.view.flat({rigid.points[3 * i + 3], rigid.points[3 * i + 4], 0}), bounds);
        if (piece.empty()) continue;
        if (d.y < -0.3) inside.add(Point{piece.left, piece.bottom + d.y * depth});
        if (d.y > 0.3) inside.add(Point{piece.left, piece.top + d.y * depth});
        if (d.x < -0.3) inside.add(Point{piece.left + d.x * depth, piece.bottom});
        if (d.x > 0.3) inside.add(Point{piece.right + d.x * depth, piece.bottom});
      }
      bounds = inside;
    }
}

Bounds pixel_bounds(Stage& stage, const Bounds& scaled) {
  stage.view.origin = {0, 0};
  const double s = stage.view.scale;
  Bounds bounds;
  bounds.add(Point{s * scaled.left, s * scaled.bottom});
  bounds.add(Point{s * scaled.right, s * scaled.top});
  add_symbols(bounds, stage);
  // Half a line and a marker stand beyond the body.
  const double rim = 0.3 * stage.em;
  bounds.add(Point{bounds.left - rim, bounds.bottom - rim});
  bounds.add(Point{bounds.right + rim, bounds.top + rim});
  return bounds;
}

}  // namespace

void aim(Stage& stage) {
  Vec3 eye{1, -1.6, 0.95};
  if (stage.picture.view_from && dot(*stage.picture.view_from, *stage.picture.view_from) > 0) {
    eye = *stage.picture.view_from;
  } else {
    Vec3 mean{0, 0, 0};
    for (const ContactPicture& contact : stage.picture.contacts)
      for (const ContactNode& node : contact.nodes) mean = plus(mean, node.normal, node.weight > 0 ? node.weight : 1);
    mean = unit(mean);
    double best = -1e9;
    for (const Vec3& candidate : {Vec3{1, -1.6, 0.95}, Vec3{-1, -1.6, 0.95}, Vec3{1, 1.6, 0.95}, Vec3{-1, 1.6, 0.95}}) {
      const double sees = dot(unit(candidate), mean);
      if (sees > best + 0.05) best = sees, eye = candidate;
    }
  }
  View& view = stage.view;
  view.towards = unit(eye);
  const Vec3 vertical = std::abs(view.towards[2]) > 0.999 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  view.right = unit(cross(vertical, view.towards));
  view.up = cross(view.towards, view.right);
}

Bounds scaled_bounds(const Stage& stage) {
  View unit_view = stage.view;
  unit_view.scale = 1, unit_view.origin = {0, 0};
  Bounds bounds;
  for (const BodyPicture& body : stage.picture.bodies)
    for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
      bounds.add(unit_view.flat(node(body, i, stage.picture.deformation)));
      if (stage.picture.undeformed_outline) bounds.add(unit_view.flat(node(body, i, 0)));
    }
  if (bounds.empty()) bounds.add(Point{0, 0});
  const double size = std::max(bounds.width(), bounds.height());
  Bounds near = bounds;
  near.add(Point{bounds.left - 0.1 * size, bounds.bottom - 0.1 * size});
  near.add(Point{bounds.right + 0.1 * size, bounds.top + 0.1 * size});
  Bounds all = bounds;
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    std::vector<Point> at;
    Bounds own;
    for (std::size_t i = 0; i < rigid.points.size() / 3; ++i) {
      at.push_back(unit_view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], rigid.points[3 * i + 2]}));
      own.add(at.back());
    }
    if (own.empty()) continue;
    const bool small = std::max(own.width(), own.height()) < 1.3 * size;
    if ((rigid.closed || !stage.plane) && small) {
      all.merge(own);
    } else {
      for (std::size_t i = 0; i + 1 < at.size(); ++i) add_clipped(all, at[i], at[i + 1], near);
    }
  }
  return all;
}

void fit(Stage& stage, const Bounds& scaled, const Box& room) {
  // A scene without extent in a direction, or in any, does not ask for room.
  const double size = std::max(scaled.width(), scaled.height());
  const double width = scaled.width() > 1e-6 * size ? scaled.width() : 0, height = scaled.height() > 1e-6 * size ? scaled.height() : 0;
  const auto share = [](double pixels, double length) { return length > 0 ? pixels / length : 1e300; };
  stage.view.scale = size > 0 ? std::min(share(room.width(), width), share(room.height(), height)) : 1;
  for (int round = 0; round < 8 && size > 0; ++round) {
    const Bounds now = pixel_bounds(stage, scaled);
    const double over_x = now.width() - room.width(), over_y = now.height() - room.height();
    const double s = stage.view.scale;
    stage.view.scale = std::max(0.2 * s, s - std::max(width > 0 ? over_x / width : -1e300, height > 0 ? over_y / height : -1e300));
    if (std::abs(stage.view.scale - s) < 1e-6 * s) break;
  }
  const Bounds now = pixel_bounds(stage, scaled);
  stage.view.origin = {(room.left + room.right) / 2 - (now.left + now.right) / 2, (room.bottom + room.top) / 2 - (now.bottom + now.top) / 2};
  const Point o = stage.view.origin;
  stage.frame = {now.left + o.x, now.bottom + o.y, now.right + o.x, now.top + o.y};
}

}  // namespace dotyk::figure
