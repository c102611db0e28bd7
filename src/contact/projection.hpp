#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "algebra/dense/quadrature.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// A point of a plane in its own coordinates; in a 2-D scene of a line, the second coordinate 0.
using Flat = Eigen::Vector2d;

/// The plane (2-D: line) through `origin` across the unit `normal`, its axes right-handed with it.
struct View {
  View(const mesh::Point& origin, const mesh::Point& normal, int dimension);
  Flat flat(const mesh::Point& x) const;      ///< the projection of x along the normal
  double height(const mesh::Point& x) const;  ///< of x above the plane

  mesh::Point origin, normal;
  std::array<mesh::Point, 2> axis{};
};

/// A facet's projection onto the plane of a view, along its normal.
struct Shadow {
  Shadow(const mesh::Mesh& mesh, mesh::Facet facet, const View& view);
  /// The corners' hats at the facet's point above x: of triangles and quadrilaterals linear and bilinear there; x should be inside.
  std::array<double, 4> hats(const Flat& x) const;
  /// The facet's shape functions there: of order 1 its hats.
  std::array<double, mesh::kMostFacetNodes> shape(const Flat& x) const;
  bool holds(const Flat& x, double tolerance) const;  ///< `tolerance` relative to the facet's width
  double height_at(const Flat& x) const;
  double size() const;             ///< length or area
  bool polynomial() const;         ///< are its hats? Not of a quadrilateral that is no parallelogram

  int corners, nodes;
  std::array<Flat, 4> at{};        ///< anticlockwise
  std::array<double, 4> height{};  ///< above the plane
  bool reversed = false;           ///< corner a is the facet's corner (corners − 1 − a): it looks against the view's normal
};

/// What two shadows have in common: the ends of a segment, the corners of a convex polygon (Sutherland and Hodgman's
/// clipping), anticlockwise; empty where less than two or three are left.
std::vector<Flat> common(const Shadow& a, const Shadow& b);
double size(const std::vector<Flat>& polygon);   ///< length or area
Flat centre(const std::vector<Flat>& polygon);   ///< mean of the corners

/// Quadrature on segments and polygons: Gauss's rule on a segment, on the triangles of a fan the collapsed one (Gauss and
/// Gauss–Jacobi); exact for polynomials of degree 2·count − 1.
class FlatQuadrature {
 public:
  explicit FlatQuadrature(int count);
  struct At {
    Flat x;
    double measure;
  };
  std::vector<At> points(const std::vector<Flat>& polygon) const;

 private:
  algebra::Quadrature rule_, collapsed_;
};

}  // namespace dotyk::contact
