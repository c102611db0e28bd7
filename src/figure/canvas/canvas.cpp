#include "figure/canvas/canvas.hpp"

#include <numbers>

namespace dotyk::figure {

namespace {

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::vector<Point> moved(std::span<const Point> points, Point by) {
  std::vector<Point> out;
  for (const Point& p : points) out.push_back(p + by);
  return out;
}

// The parts of the line in the box.
std::vector<std::vector<Point>> cropped_line(std::span<const Point> path, const Box& box) {
  std::vector<std::vector<Point>> parts;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Point p = path[i], q = path[i + 1];
    if (!crop(p, q, box)) {
      goes_on = false;
      continue;
    }
    if (!goes_on) parts.push_back({p});
    parts.back().push_back(q);
    goes_on = box.holds(path[i + 1]);
  }
  return parts;
}

}  // namespace

void Canvas::convex(std::span<const Point> corners, Colour colour, double opacity) {
  if (!std::ranges::all_of(corners, finite)) return;
  const bool inside = !clipped_ || std::ranges::all_of(corners, [&](Point p) { return clip_.holds(p); });
  std::vector<Point> rest(corners.begin(), corners.end());
  if (!inside) rest = cropped(std::move(rest), clip_);
  if (rest.size() > 2) add({Mark::Kind::polygon, moved(rest, origin_), colour, opacity});
}

void Canvas::box(const Box& b, Colour colour, double opacity) { convex(b.corners(), colour, opacity); }

void Canvas::outline(const Box& b, double width, Colour colour) { polyline(b.corners(), width, colour, {}, true); }

void Canvas::line(Point p, Point q, double width, Colour colour, double opacity) {
  if (!finite(p) || !finite(q) || (clipped_ && !crop(p, q, clip_)) || !(length(q - p) > 0)) return;
  add({Mark::Kind::line, {p + origin_, q + origin_}, colour, opacity, width});
}

void Canvas::polyline(std::span<const Point> points, double width, Colour colour, std::span<const double> dash, bool closed) {
  if (!std::ranges::all_of(points, finite)) return;
  // Points closer than a quarter of a pixel do not show.
  std::vector<Point> path;
  for (const Point& p : points)
    if (path.empty() || length(p - path.back()) > 0.25) path.push_back(p);
  if (!points.empty() && path.size() > 1) path.back() = points.back();
  if (path.size() < 2) return;
  const std::vector<double> dashes(dash.begin(), dash.end());
  if (!clipped_ || std::ranges::all_of(path, [&](Point p) { return clip_.holds(p); }))
    return add({Mark::Kind::line, moved(path, origin_), colour, 1, width, dashes, closed && path.size() > 2});
  // What lies outside is neither drawn nor dashed: it may be very long.
  if (closed && path.size() > 2) path.push_back(path.front());
  for (const std::vector<Point>& part : cropped_line(path, clip_)) add({Mark::Kind::line, moved(part, origin_), colour, 1, width, dashes});
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  if (!finite(centre)) return;
  if (!clipped_ || clip_.holds(centre, -radius)) return add({Mark::Kind::disc, {centre + origin_}, colour, 1, radius});
  std::vector<Point> corners;
  constexpr int kCorners = 64;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    corners.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  convex(corners, colour);
}

void Canvas::marker(Marker kind, Point c, double size, Colour colour) {
  const Colour white{255, 255, 255};
  const double rim = std::max(0.8, size / 12), r = size / 2;
  const auto at = [&](double x, double y, double s) { return Point{c.x + s * x, c.y + s * y}; };
  const auto shape = [&](std::initializer_list<Point> corners, double grow) {
    for (const auto& [s, paint] : {std::pair{r * grow + rim * 1.3, white}, std::pair{r * grow, colour}}) {
      std::vector<Point> moved;
      for (const Point& p : corners) moved.push_back(at(p.x, p.y, s));
      convex(moved, paint);
    }
  };
  switch (kind) {
    case Marker::disc:
      disc(c, r + rim, white);
      disc(c, r, colour);
      break;
    case Marker::ring:
      disc(c, r + rim, white);
      disc(c, r, colour);
      disc(c, r - std::max(1.2, size / 5), white);
      break;
    case Marker::square: shape({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.88); break;
    case Marker::triangle: shape({{-0.95, -0.6}, {0.95, -0.6}, {0, 1.05}}, 1.12); break;
    case Marker::down_triangle: shape({{0, -1.05}, {0.95, 0.6}, {-0.95, 0.6}}, 1.12); break;
    case Marker::diamond: shape({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, 1.2); break;
    case Marker::plus:
    case Marker::cross: {
      const double d = kind == Marker::plus ? 0 : std::numbers::pi / 4;
      for (const auto& [w, paint, l] : {std::tuple{size / 3.2 + 2 * rim, white, r * 1.1 + rim}, std::tuple{size / 3.2, colour, r * 1.1}})
        for (const double a : {d, d + std::numbers::pi / 2})
          line({c.x - l * std::cos(a), c.y - l * std::sin(a)}, {c.x + l * std::cos(a), c.y + l * std::sin(a)}, w, paint);
      break;
    }
  }
}

Marker status_marker(Status status) {
  switch (status) {
    case Status::open: return Marker::ring;
    case Status::closed: return Marker::disc;
    case Status::stick: return Marker::square;
    case Status::slip: return Marker::triangle;
  }
  return Marker::disc;
}

void Canvas::crossed_marker(Marker kind, Point c, double size, Colour colour) {
  const auto pale = [](unsigned char value) { return static_cast<unsigned char>(255 - (255 - value) / 3); };
  marker(kind, c, 1.2 * size, {pale(colour.r), pale(colour.g), pale(colour.b)});
  const double arm = 0.55 * size;
  for (const double side : {-1.0, 1.0}) line({c.x - arm, c.y - side * arm}, {c.x + arm, c.y + side * arm}, 0.16 * size, colour);
}

void Canvas::arrow(Point tail, Point head, double width, double head_length, Colour colour, double rim) {
  const double size = length(head - tail);
  if (!(size > 0)) return;
  const double tip = std::min(head_length, 0.6 * size), half = 0.38 * tip;
  const Point d{(head.x - tail.x) / size, (head.y - tail.y) / size}, across{-d.y, d.x}, neck = head - tip * d;
  if (rim > 0) {
    const Colour white{255, 255, 255};
    const double grown = (half + rim) / half * half;
    line(tail - rim * d, neck, width + 2 * rim, white);
    convex(std::array{neck - rim * d + grown * across, neck - rim * d - grown * across, head + 2 * rim * d}, white);
  }
  line(tail, head - 0.9 * tip * d, width, colour);
  convex(std::array{neck + half * across, neck - half * across, head}, colour);
}

}  // namespace dotyk::figure
