#include "figure/canvas/places.hpp"

#include <numbers>

namespace dotyk::figure {

void Occupied::add(const std::vector<Point>& curve, const Box& inside) {
  constexpr double spacing = 4;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (inside.holds(curve[i])) points_.push_back(curve[i]);
    if (i + 1 == curve.size()) break;
    const Point p = curve[i], q = curve[i + 1];
    const int n = static_cast<int>(std::min(2000.0, length(q - p) / spacing));
    for (int k = 1; k <= n; ++k) {
      const Point between = part_way(p, q, static_cast<double>(k) / (n + 1));
      if (inside.holds(between)) points_.push_back(between);
    }
  }
}

void Occupied::add(const Box& box) {
  const int nx = 1 + static_cast<int>(box.width() / 6), ny = 1 + static_cast<int>(box.height() / 6);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) points_.push_back({box.left + box.width() * i / nx, box.bottom + box.height() * j / ny});
}

bool Occupied::meets(const Box& box) const {
  return std::any_of(points_.begin(), points_.end(), [&](Point p) { return box.holds(p); });
}

namespace {

double squared_distance(const Box& box, Point p) {
  const double dx = std::max(0.0, std::max(box.left - p.x, p.x - box.right));
  const double dy = std::max(0.0, std::max(box.bottom - p.y, p.y - box.top));
  return dx * dx + dy * dy;
}

}  // namespace

bool Occupied::clear_of(const Box& box, double margin) const {
  return std::none_of(points_.begin(), points_.end(), [&](Point p) { return squared_distance(box, p) < margin * margin; });
}

double Occupied::distance(const Box& box) const {
  double least = 1e18;
  for (const Point& p : points_) least = std::min(least, squared_distance(box, p));
  return std::sqrt(least);
}

std::optional<Point> free_place(const Occupied& occupied, const Box& room, Point size, double margin) {
  if (size.x + 2 * margin > 0.7 * room.width() || size.y + 2 * margin > 0.8 * room.height()) return std::nullopt;
  const auto [left, bottom, right, top] = Box{room.left + margin, room.bottom + margin, room.right - margin - size.x, room.top - margin - size.y};
  const double centre = (left + right) / 2, middle = (bottom + top) / 2;
  for (const Point p : {Point{right, top}, {left, top}, {left, bottom}, {right, bottom}, {right, middle}, {left, middle}, {centre, top}, {centre, bottom}})
    if (!occupied.meets(Box{p.x, p.y, p.x + size.x, p.y + size.y}.grown(margin))) return p;
  return std::nullopt;
}

std::optional<Point> near_place(const Occupied& occupied, const Occupied& to, const Box& room, Point size, double margin) {
  constexpr int steps = 40;
  constexpr double kOthers = 2;  // beside another curve it would seem to belong to that
  const double x = room.width() - size.x - 2 * margin, y = room.height() - size.y - 2 * margin;
  if (x < 0 || y < 0) return std::nullopt;
  std::optional<Point> place;
  double best = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Point p{room.left + margin + x * i / steps, room.bottom + margin + y * j / steps};
      const Box block{p.x, p.y, p.x + size.x, p.y + size.y};
      if (!occupied.clear_of(block, margin)) continue;
      const double nearest = occupied.distance(block), own = to.distance(block);
      const double cost = own + kOthers * (own - nearest) + 0.02 * (p.y - room.bottom);
      if (!place || cost < best) best = cost, place = p;
    }
  return place;
}

std::optional<Point> place_beside(const Occupied& occupied, const Box& room, Point at, Point size, double margin) {
  constexpr int rings = 80, angles = 32;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < (ring == 0 ? 1 : angles); ++k) {
      // From above in both senses.
      const double angle = 0.5 * std::numbers::pi + (k % 2 ? 1 : -1) * std::numbers::pi * ((k + 1) / 2) / (0.5 * angles);
      const Point middle = at + 0.3 * ring * size.y * Point{std::cos(angle), std::sin(angle)};
      const Box box = Box::about(middle, size);
      const bool inside = box.left >= room.left + margin && box.right <= room.right - margin && box.bottom >= room.bottom + margin && box.top <= room.top - margin;
      if (inside && occupied.clear_of(box, margin)) return middle;
    }
  return std::nullopt;
}

}  // namespace dotyk::figure
