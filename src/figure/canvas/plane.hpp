// Points, boxes and polygons of a plane: pixels of a picture, or a user's coordinates; with the standard headers that all who draw
// use.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

namespace dotyk::figure {

struct Point {
  double x = 0, y = 0;
};

inline Point operator+(Point p, Point q) { return {p.x + q.x, p.y + q.y}; }
inline Point operator-(Point p, Point q) { return {p.x - q.x, p.y - q.y}; }
inline Point operator*(double factor, Point p) { return {factor * p.x, factor * p.y}; }
inline double length(Point p) { return std::hypot(p.x, p.y); }
// p at t = 0, q at t = 1.
inline Point part_way(Point p, Point q, double t) { return p + t * (q - p); }

struct Box {
  double left = 0, bottom = 0, right = 0, top = 0;
  static Box about(Point centre, Point size) { return {centre.x - size.x / 2, centre.y - size.y / 2, centre.x + size.x / 2, centre.y + size.y / 2}; }
  double width() const { return right - left; }
  double height() const { return top - bottom; }
  Point centre() const { return {(left + right) / 2, (bottom + top) / 2}; }
  std::array<Point, 2> midline() const { return {{{left, centre().y}, {right, centre().y}}}; }
  std::array<Point, 4> corners() const { return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}}; }
  Box grown(double by) const { return {left - by, bottom - by, right + by, top + by}; }
  Box moved(Point by) const { return {left + by.x, bottom + by.y, right + by.x, top + by.y}; }
  bool holds(Point p, double margin = 0) const {
    return p.x >= left - margin && p.x <= right + margin && p.y >= bottom - margin && p.y <= top + margin;
  }
  bool overlaps(const Box& b) const { return left < b.right && b.left < right && bottom < b.top && b.bottom < top; }
};

// The box moved into the frame, as far as it goes.
inline Box pushed(Box box, const Box& frame) {
  box = box.moved({std::min(0.0, frame.right - box.right), std::min(0.0, frame.top - box.top)});
  return box.moved({std::max(0.0, frame.left - box.left), std::max(0.0, frame.bottom - box.bottom)});
}

// The greatest size of the values; 0 of none.
inline double greatest(std::span<const double> values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

// The greatest of 1, 2 and 5 times a power of ten that is not above; of what is positive.
inline double round_number_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
}

// The least box about points; empty at first.
struct Bounds : Box {
  Bounds() : Box{1e300, 1e300, -1e300, -1e300} {}
  bool empty() const { return left > right; }
  void add(Point p) {
    left = std::min(left, p.x), right = std::max(right, p.x);
    bottom = std::min(bottom, p.y), top = std::max(top, p.y);
  }
  void add(const Box& box) { add(Point{box.left, box.bottom}), add(Point{box.right, box.top}); }
};

// Cuts the segment p q down to its part in the box; false: there is none (Liang and Barsky).
inline bool crop(Point& p, Point& q, const Box& box) {
  double t0 = 0, t1 = 1;
  const double d[4] = {p.x - q.x, q.x - p.x, p.y - q.y, q.y - p.y};
  const double r[4] = {p.x - box.left, box.right - p.x, p.y - box.bottom, box.top - p.y};
  for (int k = 0; k < 4; ++k) {
    if (d[k] == 0) {
      if (r[k] < 0) return false;
    } else if (d[k] < 0) {
      t0 = std::max(t0, r[k] / d[k]);
    } else {
      t1 = std::min(t1, r[k] / d[k]);
    }
  }
  if (!(t0 <= t1)) return false;
  const Point from = p, to = q;
  p = part_way(from, to, t0), q = part_way(from, to, t1);
  return true;
}

// The part of a convex polygon in the box, side by side of that (Sutherland and Hodgman). A Corner has x and y, and part_way()
// interpolates what else it has.
template <class Corner>
std::vector<Corner> cropped(std::vector<Corner> polygon, const Box& box) {
  for (const auto& [coordinate, bound, sign] : {std::tuple{&Point::x, box.left, -1}, std::tuple{&Point::x, box.right, 1},
                                                std::tuple{&Point::y, box.bottom, -1}, std::tuple{&Point::y, box.top, 1}}) {
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double a = sign * (p.*coordinate - bound), b = sign * (q.*coordinate - bound);
      if (a <= 0) kept.push_back(p);
      if ((a < 0 && b > 0) || (a > 0 && b < 0)) kept.push_back(part_way(p, q, a / (a - b)));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

}  // namespace dotyk::figure
