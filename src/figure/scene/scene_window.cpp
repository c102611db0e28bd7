// A window of the plane: how large it is drawn, and the room the pressure takes
// in it.
#include <algorithm>
#include <cmath>

#include "figure/scene/scene_fit.hpp"

namespace dotyk::figure {

namespace {

// Puts the window into the middle of the room, on whole pixels.
void place(Stage& stage, const Box& room) {
  const Window& w = *stage.window;
  const double width = std::max(room.width(), 10.0), height = std::max(room.height(), 10.0);
  const double scale = std::min(width / (w[2] - w[0]), height / (w[3] - w[1]));
  Box& f = stage.frame;
  f.left = std::round((room.left + room.right - scale * (w[2] - w[0])) / 2);
  f.bottom = std::round((room.bottom + room.top - scale * (w[3] - w[1])) / 2);
  f.right = f.left + std::max(1.0, std::round(scale * (w[2] - w[0])));
  f.top = f.bottom + std::max(1.0, std::round(scale * (w[3] - w[1])));
  stage.view.scale = scale;
  stage.view.origin = {f.left - scale * w[0], f.bottom - scale * w[1]};
  stage.set_greatest();
}

// Those sides of the frame through which the contact itself leaves it, the
// others far away: its pressure is cut there as it is.
Box crossed_sides(const Stage& stage, const ContactPicture& contact) {
  Box f{-1e9, -1e9, 1e9, 1e9};
  if (contact.nodes_per_facet != 2) return f;
  const Box& frame = stage.frame;
  for (const auto& [a, b] : pairs(contact.facets)) {
    const Point p = stage.at(contact.nodes[a]), q = stage.at(contact.nodes[b]);
    if (!stage.shows(p, q)) continue;
    if (std::min(p.x, q.x) < frame.left) f.left = frame.left;
    if (std::min(p.y, q.y) < frame.bottom) f.bottom = frame.bottom;
    if (std::max(p.x, q.x) > frame.right) f.right = frame.right;
    if (std::max(p.y, q.y) > frame.top) f.top = frame.top;
  }
  return f;
}

// Ordinates and labels of the pressure, as far as they ask for room: in the
// direction they stand in.
Bounds pressure_bounds(const Stage& stage) {
  Bounds bounds;
  if (!(stage.strips() || stage.arrows()) || !(stage.greatest_pressure > 0)) return bounds;
  const Box& f = stage.frame;
  const double pad = 0.3 * stage.em;
  for (const ContactPicture& contact : stage.picture.contacts) {
    const Box crossed = crossed_sides(stage, contact);
    const auto add = [&](Point p, Point n) {
      const Box& across = std::abs(n.x) < 0.5 ? f : crossed;
      const Box& up = std::abs(n.y) < 0.5 ? f : crossed;
      bounds.add(Point{std::clamp(p.x, across.left, across.right), std::clamp(p.y, up.bottom, up.top)});
    };
    for (const ContactNode& node : contact.nodes) {
      const Point n = stage.view.direction(node.normal);
      if (node.pressure > 0 && stage.shows(stage.at(node))) add(pressure_tip(stage, node) + pad * n, n);
    }
    if (const std::optional<Label> label = peak_label(stage, contact, false)) {
      const Box box = label->box.grown(pad);
      add({box.left, box.bottom}, label->direction), add({box.right, box.top}, label->direction);
    }
  }
  return bounds;
}

// The tallest drawing of the pressure that fits, or the least that will do.
// Returns what of it lies beyond each side of the frame.
Window settle_pressure(Stage& stage) {
  Window beyond{0, 0, 0, 0};
  for (double share = 0.2; share > 0.149; share -= 0.01) {
    stage.window_strip = std::max(share * stage.frame.height(), 1.5 * stage.em);
    const Bounds need = pressure_bounds(stage);
    if (need.empty()) return {0, 0, 0, 0};
    const Box& f = stage.frame;
    beyond = {std::max(0.0, f.left - need.left), std::max(0.0, f.bottom - need.bottom),
              std::max(0.0, need.right - f.right), std::max(0.0, need.top - f.top)};
    if (std::all_of(beyond.begin(), beyond.end(), [](double pixels) { return pixels == 0; })) break;
  }
  return beyond;
}

}  // namespace

void fit_window(Stage& stage, const Box& room) {
  stage.window = stage.picture.window;
  for (int round = 0; round < 20; ++round) {
    place(stage, room);
    const Window beyond = settle_pressure(stage);
    if (std::all_of(beyond.begin(), beyond.end(), [](double pixels) { return pixels < 0.5; })) break;
    for (std::size_t side = 0; side < 4; ++side) (*stage.window)[side] += (side < 2 ? -1 : 1) * beyond[side] / stage.view.scale;
  }
  stage.scale = colour_scale(stage.picture, stage.window);
}

}  // namespace dotyk::figure
