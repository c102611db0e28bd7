// From the user's coordinates to pixels, and the outlines of bodies.
#pragma once

#include <array>
#include <vector>

#include "figure/canvas/canvas.hpp"
#include "figure/door/picture.hpp"

namespace dotyk::figure {

double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
Vec3 plus(const Vec3& a, const Vec3& b, double factor = 1);  // a + factor b
Vec3 unit(const Vec3& a);                                    // 0 stays 0

// Parallel projection. A point becomes pixels across and up, and pixels
// towards the eye; in the plane right, up, towards are x, y, z.
struct View {
  Vec3 right = {1, 0, 0}, up = {0, 1, 0}, towards = {0, 0, 1};
  double scale = 1;  // pixels per unit of length
  Point origin;      // pixel of the world's origin

  Vec3 pixel(const Vec3& p) const {
    return {origin.x + scale * dot(p, right), origin.y + scale * dot(p, up), scale * dot(p, towards)};
  }
  Point flat(const Vec3& p) const { return {origin.x + scale * dot(p, right), origin.y + scale * dot(p, up)}; }
  Point direction(const Vec3& d) const;  // unit, or 0 where d points at the eye
};

// The point of node i, displaced by `factor` times its displacement.
Vec3 node(const BodyPicture& body, std::size_t i, double factor);

// The body's facets, or, where it gives none, the cell facets that belong to
// one cell only. nodes_per_facet of the body says their length.
struct Facets {
  std::vector<int> nodes;
  int each = 2;
};
Facets boundary(const BodyPicture& body);

// Every edge of polygons with `each` corners once, two nodes an edge.
std::vector<int> unique_edges(const std::vector<int>& polygons, int each);

// Those edges of polygons that belong to one polygon only.
std::vector<int> rim(const std::vector<int>& polygons, int each);

// Edges of the plane hung together: node lists, a closed one ends in its
// first node.
std::vector<std::vector<int>> chains(const std::vector<int>& edges);

// Least and greatest corner of points in the picture's plane.
struct Bounds {
  double left = 1e300, bottom = 1e300, right = -1e300, top = -1e300;
  void add(Point p);
  void merge(const Bounds& b);
  bool empty() const { return left > right; }
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

}  // namespace dotyk::figure
