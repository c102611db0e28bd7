// The greatest pressure in words, where it covers nothing.
#include <algorithm>
#include <cmath>

#include "figure/scene/stage.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

namespace {

using Line = std::array<Point, 2>;

// Outlines of bodies, surfaces of obstacles and the ends of their hatching,
// ordinates of pressure: those of them that come near a place.
class Barriers {
public:
  Barriers(const Stage& stage, const Box& near) : near_(near) {
    const ScenePicture& p = stage.picture;
    if (!stage.plane) return;
    for (const BodyPicture& body : p.bodies) {
      const std::vector<int>& edges = body.facets;
      for (std::size_t e = 0; e + 1 < edges.size(); e += 2) {
        const auto a = static_cast<std::size_t>(edges[e]), b = static_cast<std::size_t>(edges[e + 1]);
        add(stage.view.flat(node(body, a, p.deformation)), stage.view.flat(node(body, b, p.deformation)));
        if (p.undeformed_outline) add(stage.view.flat(node(body, a, 0)), stage.view.flat(node(body, b, 0)));
      }
    }
    for (const RigidPicture& rigid : p.obstacles) add_obstacle(stage, rigid);
    for (const ContactPicture& contact : p.contacts) add_tips(stage, contact);
  }

  bool cross(const Box& box) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](Line line) { return crop(line[0], line[1], box); });
  }

private:
  void add(Point p, Point q) {
    Point a = p, b = q;
    if (crop(a, b, near_)) lines_.push_back({p, q});
  }

  void add_obstacle(const Stage& stage, const RigidPicture& rigid) {
    const Point into = stage.view.direction(rigid.into_solid);
    const double depth = rigid.closed ? 0 : hatch_depth * stage.em;
    const std::size_t n = rigid.points.size() / 3;
    for (std::size_t i = 0; i + (rigid.closed ? 0 : 1) < n; ++i) {
      const std::size_t j = (i + 1) % n;
      const Point p = stage.view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], 0});
      const Point q = stage.view.flat({rigid.points[3 * j], rigid.points[3 * j + 1], 0});
      add(p, q);
      add({p.x + depth * into.x, p.y + depth * into.y}, {q.x + depth * into.x, q.y + depth * into.y});
    }
  }

  void add_tips(const Stage& stage, const ContactPicture& contact) {
    if (contact.nodes_per_facet != 2) return;
    for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
      const ContactNode &a = contact.nodes[static_cast<std::size_t>(contact.facets[f])], &b = contact.nodes[static_cast<std::size_t>(contact.facets[f + 1])];
      if (!(a.pressure > 0) && !(b.pressure > 0)) continue;
      const Point p = stage.view.flat(stage.place(a)), q = stage.view.flat(stage.place(b));
      const Point s = pressure_tip(stage, a, p), t = pressure_tip(stage, b, q);
      add(s, t), add(p, s), add(q, t);
    }
  }

  Box near_;
  std::vector<Line> lines_;
};

Box moved(const Box& box, double dx, double dy) { return {box.left + dx, box.bottom + dy, box.right + dx, box.top + dy}; }
Box grown(const Box& box, double by) { return {box.left - by, box.bottom - by, box.right + by, box.top + by}; }

// Into the frame, as far as it goes.
Box pushed(Box box, const Box& frame) {
  box = moved(box, std::min(0.0, frame.right - box.right), std::min(0.0, frame.top - box.top));
  return moved(box, std::max(0.0, frame.left - box.left), std::max(0.0, frame.bottom - box.bottom));
}

// The free place nearest to the wanted one: farther out along n first, then to
// the sides of it.
Box free_place(const Stage& stage, const Box& wanted, Point n, bool within_frame) {
  const double em = stage.em;
  // A window's sides cut the contact; a label there moves along it.
  const bool upright = std::abs(n.y) >= std::abs(n.x);
  Box lateral = grown(stage.frame, -0.3 * em);
  if (!within_frame && upright) lateral.bottom = -1e9, lateral.top = 1e9;
  if (!within_frame && !upright) lateral.left = -1e9, lateral.right = 1e9;
  const auto settled = [&](const Box& box) { return stage.window ? pushed(box, lateral) : box; };
  const Barriers barriers(stage, grown(wanted, 12 * em));
  const Point along{-n.y, n.x};
  const double step_out = 0.4 * em, step_along = 0.25 * (upright ? wanted.width() : wanted.height());
  struct Try {
    double cost;
    Box box;
  };
  std::vector<Try> tries;
  for (int out = 0; out <= 12; ++out)
    for (const int side : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
      const double a = out * step_out, b = side * step_along;
      tries.push_back({a + 0.6 * std::abs(b), settled(moved(wanted, a * n.x + b * along.x, a * n.y + b * along.y))});
    }
  std::stable_sort(tries.begin(), tries.end(), [](const Try& p, const Try& q) { return p.cost < q.cost; });
  for (const Try& t : tries)
    if (!barriers.cross(grown(t.box, 0.12 * em))) return t.box;
  return settled(wanted);
}

std::string words(const Stage& stage, const ContactPicture& contact, double pressure) {
  double greatest = 0;
  for (const ContactNode& node : contact.nodes) greatest = std::max(greatest, node.pressure);
  const std::string& unit = stage.picture.pressure_unit;
  // A window may not show the greatest: then the number is that of the tallest ordinate in it.
  return (pressure < greatest ? "" : "max ") + number(pressure) + (unit.empty() ? "" : " " + unit);
}

}  // namespace

Point pressure_tip(const Stage& stage, const ContactNode& node, Point at) {
  if (!(stage.greatest_pressure > 0)) return at;
  const Point n = stage.view.direction(node.normal);
  const double length = stage.strip_height() * std::max(0.0, node.pressure) / stage.greatest_pressure;
  return {at.x + length * n.x, at.y + length * n.y};
}

std::optional<PeakLabel> peak_label(const Stage& stage, const ContactPicture& contact, bool within_frame) {
  double greatest = 0;
  std::vector<bool> seen;
  for (const ContactNode& node : contact.nodes) {
    seen.push_back(stage.shows(stage.view.flat(stage.place(node))));
    if (seen.back()) greatest = std::max(greatest, node.pressure);
  }
  if (!(greatest > 0) || greatest < 0.02 * stage.greatest_pressure) return std::nullopt;
  // Of equal peaks that in the middle.
  std::vector<const ContactNode*> peaks;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i] && contact.nodes[i].pressure >= 0.9999 * greatest) peaks.push_back(&contact.nodes[i]);
  const ContactNode& peak = *peaks[peaks.size() / 2];
  PeakLabel label;
  label.text = words(stage, contact, greatest);
  label.size = 0.85 * stage.em;
  const Point at = stage.view.flat(stage.place(peak)), tip = pressure_tip(stage, peak, at), n = stage.view.direction(peak.normal);
  const Point size = text_extent(label.text, label.size);
  const double dx = n.x * (size.x / 2 + 0.35 * stage.em), dy = n.y * (size.y / 2 + 0.3 * stage.em);
  const Box wanted{tip.x + dx - size.x / 2, tip.y + dy - size.y / 2, tip.x + dx + size.x / 2, tip.y + dy + size.y / 2};
  label.direction = n;
  label.box = stage.plane ? free_place(stage, wanted, n, within_frame) : wanted;
  return label;
}

}  // namespace dotyk::figure
