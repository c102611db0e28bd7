#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// The set {t : A t ≤ b} by what generates it: convex combinations of the vertices, plus non-negative multiples of the
/// rays, plus any multiples of the lines. Columns; rays and lines have unit length, lines are independent. Without
/// vertices it is empty. With lines, the vertices are points of its least faces.
struct Polyhedron {
  DenseMatrix vertices, rays, lines;
  bool empty() const { return vertices.cols() == 0; }
  bool bounded() const { return rays.cols() + lines.cols() == 0; }
  /// Of its affine hull; -1: empty. Vertices closer together than `tolerance` are one.
  int dimension(double tolerance) const;
};

/// By the double description method (Motzkin, Raiffa, Thompson, Thrall 1953) on the cone over the set. t should be scaled to
/// a size of about 1: `tolerance` is on A t − b with rows of A of unit length. For few dimensions: the number of vertices
/// grows as binomials do. Throws std::runtime_error beyond 10⁵ of them.
Polyhedron polyhedron(const DenseMatrix& A, const Vector& b, double tolerance = 1e-9);

}  // namespace dotyk::algebra
