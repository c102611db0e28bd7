// A window of the plane: how large it is drawn, and the room the pressure takes
// in it.
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

// Puts the window into the middle of the room, on whole pixels.
void place(Stage& stage, const Box& room) {
  const Box& w = *stage.window;
  const double scale = std::min(std::max(room.width(), 10.0) / w.width(), std::max(room.height(), 10.0) / w.height());
  Box& f = stage.frame;
  f.left = std::round((room.left + room.right - scale * w.width()) / 2);
  f.bottom = std::round((room.bottom + room.top - scale * w.height()) / 2);
  f.right = f.left + std::max(1.0, std::round(scale * w.width()));
  f.top = f.bottom + std::max(1.0, std::round(scale * w.height()));
  stage.view.scale = scale;
  stage.view.origin = {f.left - scale * w.left, f.bottom - scale * w.bottom};
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
  if (!stage.pressures() || !(stage.greatest_pressure > 0)) return bounds;
  const Box& f = stage.frame;
  const double pad = 0.3 * stage.em;
  const std::vector<std::optional<Label>> labels = peak_labels(stage, false);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const ContactPicture& contact = stage.picture.contacts[k];
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
    // Beside the ordinates a label finds room within the frame.
    if (const std::optional<Label>& label = labels[k]; label && std::abs(label->direction.y) >= std::abs(label->direction.x)) {
      const Box box = label->box.grown(pad);
      add({box.left, box.bottom}, label->direction), add({box.right, box.top}, label->direction);
    }
  }
  return bounds;
}

double farthest(const Box& sides) { return std::max({sides.left, sides.bottom, sides.right, sides.top}); }

// The tallest drawing of the pressure that fits, or the least that will do.
// Returns what of it lies beyond each side of the frame.
Box settle_pressure(Stage& stage) {
  Box beyond;
  for (double share = 0.2; share > 0.149; share -= 0.01) {
    stage.window_strip = std::max(share * stage.frame.height(), 1.5 * stage.em);
    const Bounds need = pressure_bounds(stage);
    if (need.empty()) return {};
    const Box& f = stage.frame;
    beyond = {std::max(0.0, f.left - need.left), std::max(0.0, f.bottom - need.bottom),
              std::max(0.0, need.right - f.right), std::max(0.0, need.top - f.top)};
    if (farthest(beyond) == 0) break;
  }
  return beyond;
}

}  // namespace

void fit_window(Stage& stage, const Box& room) {
  Box& w = *(stage.window = stage.asked);
  for (int round = 0; round < 20; ++round) {
    place(stage, room);
    const Box beyond = settle_pressure(stage);
    if (farthest(beyond) < 0.5) break;
    const double s = stage.view.scale;
    w = {w.left - beyond.left / s, w.bottom - beyond.bottom / s, w.right + beyond.right / s, w.top + beyond.top / s};
  }
  stage.scale = colour_scale(stage.picture, stage.window);
}

}  // namespace dotyk::figure
