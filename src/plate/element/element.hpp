#pragma once

#include <array>
#include <memory>

#include <Eigen/Core>

#include "plate/plate.hpp"
#include "plate/element/edges.hpp"

namespace dotyk::plate {

using Barycentric = Eigen::Vector3d;

/// Shape functions at a point, a column each.
struct Shape {
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12> value;
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 12> gradient;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 12> curvature;  ///< ∂xx, ∂yy, 2∂xy
};

using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;
using LocalVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;

/// A triangle: edge k goes from vertex k to vertex k + 1.
struct Triangle {
  std::array<Eigen::Vector2d, 3> x;
  double area;
  std::array<double, 3> length, sign;          ///< sign: 1 where the edge's normal is outward
  std::array<Eigen::Vector2d, 3> tangent, normal;  ///< counter-clockwise, outward
  Eigen::Matrix<double, 2, 3> barycentric_gradient;
  Eigen::Vector2d point(const Barycentric& b) const { return b[0] * x[0] + b[1] * x[1] + b[2] * x[2]; }
};
Triangle triangle(const mesh::Mesh& mesh, const Edges& edges, int cell);

/// The shape functions of one cell. Freedoms: of Morley's element the deflections of the vertices and the normal slopes of the
/// edge middles; of HCT (u, ∂x u, ∂y u) of each vertex and the same slopes; along the edges' own normals.
class Basis {
 public:
  virtual ~Basis() = default;
  virtual int size() const = 0;
  /// On the line between two pieces of a cell: of one of them.
  virtual Shape at(const Barycentric& point) const = 0;
  /// The same, without the value and the gradient.
  virtual Shape curvature_at(const Barycentric& point) const = 0;
  /// The values alone.
  virtual Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12> value_at(const Barycentric& point) const { return at(point).value; }
};
std::unique_ptr<const Basis> basis(Element element, const Triangle& triangle);

/// A rule on a triangle: points, and weights that sum to 1.
struct Rule {
  std::vector<Barycentric> points;
  std::vector<double> weights;
};
/// Exact for what the element makes of a stiffness: D piecewise linear (Morley), constant on thirds of a cell (HCT).
const Rule& stiffness_rule(Element element);
/// For ∫ f v: exact for polynomials f of degree 3 (Morley) and 2 (HCT).
const Rule& load_rule(Element element);

/// ∫ D κᵀ C κ, D at the rule's points, κ the curvatures: C = [1 ν 0; ν 1 0; 0 0 (1 − ν)/2].
LocalMatrix stiffness(const Basis& basis, const Rule& rule, const Triangle& triangle, double nu, const double* D);

/// C of the bending stiffness 1.
Eigen::Matrix3d bending(double nu);

}  // namespace dotyk::plate
