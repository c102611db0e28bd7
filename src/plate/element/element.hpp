#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "plate/plate.hpp"

namespace dotyk::plate {

/// An edge of the mesh, from node[0] to node[1] counter-clockwise about its first cell.
struct Edge {
  std::array<int, 2> node;
  int cell;                ///< its first, on the boundary its only one
  bool boundary = false;
  double length = 0;
  Eigen::Vector2d middle, tangent, normal;  ///< units; the normal out of its first cell
};

struct Edges {
  std::vector<Edge> edges;
  std::vector<std::array<int, 3>> of_cell;   ///< edge of each facet of a cell
  /// 1, or −1 where the edge's normal points into the cell.
  double sign(int cell, int local) const { return edges[of_cell[cell][local]].cell == cell ? 1 : -1; }
};

/// The node in the plane.
inline Eigen::Vector2d node_position(const mesh::Mesh& mesh, int node) { return {mesh.node(node)[0], mesh.node(node)[1]}; }

Edges find_edges(const mesh::Mesh& mesh);

/// The boundary at a node where it turns by less than 35° counts as smooth: as that of a curve that the mesh approximates. There
/// laws act along the curve's own normal and tangent, not the edges', lest a polygon's solution be taken for the
/// curve's: Babuška's paradox (Bartels and Tscherner 2023).
struct BoundaryNode {
  std::vector<int> edges;           ///< of the boundary, that meet here
  bool smooth = false;
  Eigen::Vector2d normal{0, 0};     ///< mean of the edges', a unit; where smooth
};

/// One a node of the mesh; those within have no edges.
std::vector<BoundaryNode> find_boundary_nodes(const mesh::Mesh& mesh, const Edges& edges);

/// How far the curve through the ends of a boundary edge, with the nodes' normals, stands out of the edge's middle: length
/// × (angle of the normals)/8, which is right for a circle to its third power.
double sagitta(const Edge& edge, const std::vector<BoundaryNode>& nodes);

using Barycentric = Eigen::Vector3d;

/// Of shape functions at a point, a column each; curvatures ∂xx, ∂yy, 2∂xy.
using Values = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12>;
using Gradients = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 12>;
using Curvatures = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 12>;
struct Shape {
  Values value;
  Gradients gradient;
  Curvatures curvature;
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
  virtual Values value(const Barycentric& point) const = 0;
  virtual Gradients gradient(const Barycentric& point) const = 0;
  virtual Curvatures curvature(const Barycentric& point) const = 0;
  Shape at(const Barycentric& point) const { return {value(point), gradient(point), curvature(point)}; }
};
std::unique_ptr<const Basis> morley(const Triangle& triangle);
std::unique_ptr<const Basis> hct(const Triangle& triangle);
inline std::unique_ptr<const Basis> basis(Element element, const Triangle& triangle) { return element == Element::morley ? morley(triangle) : hct(triangle); }

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
