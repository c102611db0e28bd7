#include "figure/scene/scene_fit.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::figure {

namespace {

// Of what grows with the scale and of symbols, which do not, at the present scale with origin (0, 0).
Bounds pixel_bounds(Stage& stage, const Bounds& scaled) {
  stage.view.origin = {0, 0};
  const double s = stage.view.scale;
  Bounds bounds;
  bounds.add(Box{s * scaled.left, s * scaled.bottom, s * scaled.right, s * scaled.top});
  std::vector<Layer> downwards = stage.layers;
  std::stable_sort(downwards.begin(), downwards.end(), [](const Layer& a, const Layer& b) { return a.height > b.height; });
  for (const Layer& layer : downwards)
    if (layer.bounds) layer.bounds(stage, bounds);
  bounds.add(bounds.grown(0.3 * stage.em));  // half a line and a marker stand beyond the body
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
  Bounds all;
  for (const BodyPicture& body : stage.picture.bodies)
    for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
      all.add(unit_view.flat(node(body, i, stage.picture.deformation)));
      if (stage.picture.undeformed_outline) all.add(unit_view.flat(node(body, i, 0)));
    }
  if (all.empty()) all.add(Point{0, 0});
  const double size = std::max(all.width(), all.height());
  const Box near = all.grown(0.1 * size);
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    std::vector<Point> at;
    Bounds own;
    for (std::size_t i = 0; i < rigid.points.size() / 3; ++i) {
      at.push_back(unit_view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], rigid.points[3 * i + 2]}));
      own.add(at.back());
    }
    if (own.empty()) continue;
    if ((rigid.closed || !stage.plane) && std::max(own.width(), own.height()) < 1.3 * size) all.add(own);
    else
      for (std::size_t i = 0; i + 1 < at.size(); ++i)
        if (Point p = at[i], q = at[i + 1]; crop(p, q, near)) all.add(p), all.add(q);
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
  stage.view.origin = room.centre() - now.centre();
  stage.frame = now.moved(stage.view.origin);
}

}  // namespace dotyk::figure
