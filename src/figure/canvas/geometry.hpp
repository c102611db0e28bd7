// From the user's coordinates to pixels, and the outlines of bodies.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ranges>
#include <span>
#include <vector>

#include "figure/canvas/canvas.hpp"
#include "figure/door/picture.hpp"

namespace dotyk::figure {

double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
Vec3 plus(const Vec3& a, const Vec3& b, double factor = 1);  // a + factor b
Vec3 part_way(const Vec3& p, const Vec3& q, double t);       // p at t = 0, q at t = 1
double length(const Vec3& a);
Vec3 unit(const Vec3& a);                                    // 0 stays 0

// Parallel projection. A point becomes pixels across and up, and pixels
// towards the eye; in the plane right, up, towards are x, y, z.
struct View {
  Vec3 right = {1, 0, 0}, up = {0, 1, 0}, towards = {0, 0, 1};
  double scale = 1;  // pixels per unit of length
  double depth = 0;  // towards the eye, of what is at pixel 0
  Point origin;      // pixel of the world's origin

  Vec3 pixel(const Vec3& p) const {
    return {origin.x + scale * dot(p, right), origin.y + scale * dot(p, up), scale * (dot(p, towards) - depth)};
  }
  Point flat(const Vec3& p) const { return {origin.x + scale * dot(p, right), origin.y + scale * dot(p, up)}; }
  Point direction(const Vec3& d) const;  // unit, or 0 where d points at the eye
};

// The parts of a polygon that are next to its corners, in the order of these: corner, middle of the next side, centre, middle of the last.
template <class P>
std::vector<std::array<P, 4>> quarters(const std::vector<P>& corner) {
  const std::size_t n = corner.size();
  P centre = corner[0];
  for (std::size_t k = 1; k < n; ++k) centre = part_way(centre, corner[k], 1.0 / static_cast<double>(k + 1));
  std::vector<std::array<P, 4>> out;
  for (std::size_t k = 0; k < n; ++k) out.push_back({corner[k], part_way(corner[k], corner[(k + 1) % n], 0.5), centre, part_way(corner[k], corner[(k + n - 1) % n], 0.5)});
  return out;
}

// Hatching of a convex polygon: parallel lines at 45 degrees, `spacing` apart. They continue across adjacent polygons.
template <class P>
std::vector<std::array<P, 2>> hatched(std::span<const P> corner, double spacing) {
  const auto level = [&](const P& p) {
    if constexpr (std::is_same_v<P, Point>) return (p.x - p.y) / (std::numbers::sqrt2 * spacing);
    else return (p[0] - p[1]) / (std::numbers::sqrt2 * spacing);
  };
  std::vector<std::array<P, 2>> out;
  if (corner.empty()) return out;
  const auto [low, high] = std::ranges::minmax(corner | std::views::transform(level));
  for (double at = std::ceil(low); at < high; ++at) {
    std::vector<P> ends;
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const P &p = corner[c], &q = corner[(c + 1) % corner.size()];
      const double a = level(p) - at, b = level(q) - at;
      if ((a > 0) != (b > 0)) ends.push_back(part_way(p, q, a / (a - b)));
    }
    if (ends.size() == 2) out.push_back({ends[0], ends[1]});
  }
  return out;
}

using Segment = std::array<Point, 2>;
double distance(const Segment& segment, Point p);
double distance(const Segment& a, const Segment& b);  // of two that do not cross

// Polygons of `each` corners.
struct Facets {
  std::vector<int> nodes;
  int each = 2;
};

// Calls act with the nodes of each polygon.
template <class Do>
void each_polygon(const Facets& polygons, Do&& act) {
  const auto each = static_cast<std::size_t>(polygons.each);
  for (std::size_t f = 0; f + each <= polygons.nodes.size(); f += each) act(std::span(polygons.nodes).subspan(f, each));
}

// Every edge of the polygons once, two nodes an edge.
std::vector<int> unique_edges(const Facets& polygons);

// Those edges of the polygons that belong to one polygon only.
std::vector<int> rim(const Facets& polygons);

// Nodes two by two, as edges have them.
std::vector<std::array<int, 2>> pairs(const std::vector<int>& edges);

// Edges hung together: node lists, a closed one ends in its first node.
std::vector<std::vector<int>> chains(const std::vector<int>& edges);

}  // namespace dotyk::figure
