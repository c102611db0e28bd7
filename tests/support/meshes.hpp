#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mesh/bisection.hpp"
#include "mesh/generators.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::test {

using mesh::Family;
using mesh::Mesh;
using mesh::Point;

/// A round of one mesh alone.
inline mesh::Refined refine(mesh::Bisection& mesh, const std::vector<int>& cells) {
  Monitor unwatched;
  return mesh::refine({&mesh}, {cells}, {}, unwatched).front();
}

inline constexpr Family kFamilies[] = {Family::p1, Family::q1};     ///< of order 1
inline constexpr Family kSecondOrder[] = {Family::p2, Family::q2};
inline constexpr Family kAllFamilies[] = {Family::p1, Family::q1, Family::p2, Family::q2};

inline std::string name(Family family) {
  switch (family) {
    case Family::p1: return "P1";
    case Family::q1: return "Q1";
    case Family::p2: return "P2";
    default: return "Q2";
  }
}

inline Mesh rectangle(Family family, int nx, int ny, double x0 = 0, double y0 = 0, double x1 = 1, double y1 = 1) {
  const double from[2] = {x0, y0}, to[2] = {x1, y1};
  const int cells[2] = {nx, ny};
  const mesh::Grading even[2];
  return mesh::rectangle(from, to, cells, family, even);
}

inline Mesh box(Family family, int nx, int ny, int nz, Point from = {0, 0, 0}, Point to = {1, 1, 1}) {
  const int cells[3] = {nx, ny, nz};
  const mesh::Grading even[3];
  return mesh::box(from.data(), to.data(), cells, family, even);
}

/// A unit square or cube of n cells along each edge.
inline Mesh unit(int dimension, Family family, int n) {
  return dimension == 2 ? rectangle(family, n, n) : box(family, n, n, n);
}

inline Mesh disc(Family family, int cells, double x = 0, double y = 0, double radius = 1) {
  const double centre[2] = {x, y};
  return mesh::disc(centre, radius, cells, family);
}

/// Nodes between corners put back to their mean: cells of order 2 made straight.
inline void straighten(Mesh& m) {
  const mesh::ElementTopology& t = m.topology();
  for (int c = 0; c < m.cell_count(); ++c)
    for (std::size_t k = 0; k < t.between.size(); ++k)
      for (int i = 0; i < t.dimension; ++i) {
        double& x = m.coordinates[static_cast<std::size_t>(m.cell(c)[t.corners + k]) * t.dimension + i];
        x = 0;
        for (const int corner : t.between[k]) x += m.node(m.cell(c)[corner])[i] / static_cast<double>(t.between[k].size());
      }
}

/// Where a smooth map that leaves the boundary of the unit square or cube in place, and moves inner points by up to `amount`, puts x.
inline Point bumped(const Point& x, int dimension, double amount) {
  Point y = x;
  double bump = amount;
  for (int i = 0; i < dimension; ++i) bump *= 4 * x[i] * (1 - x[i]);
  for (int i = 0; i < dimension; ++i) y[i] += bump * std::sin(7 * x[0] + 5 * x[1] + 3 * x[2] + 2 * i);
  return y;
}

/// All nodes moved so: cells of order 2 become curved.
inline void curve(Mesh& m, double amount) {
  mesh::transform(m, [&](const Point& x) { return bumped(x, m.dimension(), amount); });
}

/// Corners moved so, cells straight.
inline void distort(Mesh& m, double amount) {
  const int dim = m.dimension();
  for (int n = 0; n < m.node_count(); ++n) {
    const Point x = bumped(m.point(n), dim, amount);
    std::copy_n(x.begin(), dim, m.coordinates.begin() + static_cast<std::ptrdiff_t>(n) * dim);
  }
  straighten(m);
  mesh::check(m, "distorted");
}

/// Area of a triangle or quadrilateral (shoelace), volume of a tetrahedron or a hexahedron (by the
/// divergence theorem over its facets, exact where they are plane).
inline double measure(const Mesh& m, int cell) {
  const auto& t = m.topology();
  double sum = 0;
  for (int l = 0; l < t.facets; ++l) {
    const Point x = m.facet_centre({cell, l}), n = m.facet_area_vector({cell, l});
    for (int i = 0; i < t.dimension; ++i) sum += x[i] * n[i] / t.dimension;
  }
  return sum;
}

inline double measure(const Mesh& m) {
  double sum = 0;
  for (int c = 0; c < m.cell_count(); ++c) sum += measure(m, c);
  return sum;
}

inline double length(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

/// Sum of the facets' lengths or areas.
inline double measure(const Mesh& m, const std::vector<mesh::Facet>& facets) {
  double sum = 0;
  for (const auto f : facets) sum += length(m.facet_area_vector(f));
  return sum;
}

}  // namespace dotyk::test
