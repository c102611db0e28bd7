#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dotyk::mesh {

/// A point of the plane or of space, or a vector; z = 0 in the plane.
using Point = std::array<double, 3>;

/// a·b
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// a + b
inline Point plus(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// a − b
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// factor a
inline Point times(double factor, const Point& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }

/// a × b
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// |a|, squares out of the range of numbers avoided.
inline double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

/// a/|a|; a is not zero.
inline Point unit(const Point& a) {
  const double size = length(a);
  return {a[0] / size, a[1] / size, a[2] / size};
}

/// How far d leads off the line along a unit vector.
inline double off_line(const Point& d, const Point& along) { return length(minus(d, times(dot(d, along), along))); }

/// The vector that a list of vectors (node × dimension) has at a node.
inline Point at_node(const std::vector<double>& nodal, int node, int dimension) {
  Point v{0, 0, 0};
  std::copy_n(nodal.begin() + static_cast<std::ptrdiff_t>(node) * dimension, dimension, v.begin());
  return v;
}

/// A box along the axes around what was added to it.
struct Box {
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  void add(const Point& x) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
  }
  void add(const Box& other) { add(other.low), add(other.high); }
  void grow(double by) {
    for (int i = 0; i < 3; ++i) low[i] -= by, high[i] += by;
  }
  bool holds(const Point& x) const {
    for (int i = 0; i < 3; ++i)
      if (!(x[i] >= low[i] && x[i] <= high[i])) return false;
    return true;
  }
  double extent(int axis) const { return high[axis] - low[axis]; }
};

}  // namespace dotyk::mesh
