#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

#include "algebra/types.hpp"
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

/// A linear functional of the freedoms: what a deflection or slope is of them.
struct Term {
  int freedom;
  double factor;
};
using Functional = std::vector<Term>;

/// The freedoms of a mesh: deflections, and slopes times `unit`, so that all are lengths and what does work on them forces. Morley: u of the
/// vertices, ∂ₙu of the edges. HCT: (u, and the gradient's two components in a frame of the vertex's own) of the vertices, ∂ₙu of the edges.
struct Space {
  Element element;
  const mesh::Mesh* mesh;
  Edges edges;
  std::vector<BoundaryNode> boundary;          ///< one a vertex
  std::vector<Eigen::Vector2d> frame;          ///< HCT: first axis of each vertex's gradient, on the boundary along it; the second is 90° to its left
  double unit = 1;

  Space(Element element, const mesh::Mesh& mesh);

  int per_vertex() const { return element == Element::morley ? 1 : 3; }
  int local_size() const { return element == Element::morley ? 6 : 12; }
  int count() const { return per_vertex() * mesh->node_count() + static_cast<int>(edges.edges.size()); }
  int of_vertex(int vertex) const { return per_vertex() * vertex; }
  int of_edge(int edge) const { return per_vertex() * mesh->node_count() + edge; }
  /// Vertex, or the count of vertices and the edge: what orderings keep together.
  int node(int freedom) const;
  /// Of a cell, in the order of Basis.
  std::array<int, 12> freedoms(int cell) const;
  /// The values that a cell's freedoms have among all.
  LocalVector of_cell(int cell, const algebra::Vector& freedoms) const;
  /// From functions of a cell's Basis to those of its freedoms here: each factor of the row. Columns of a row-wise quantity are replaced.
  template <class Columns>
  void to_freedoms(int cell, Columns& columns) const {
    const double slope = 1 / unit;
    const int vertices = element == Element::morley ? 0 : 3;
    for (int k = 0; k < vertices; ++k) {
      const Eigen::Vector2d a = frame[mesh->cell(cell)[k]];
      const auto x = columns.col(3 * k + 1).eval(), y = columns.col(3 * k + 2).eval();
      columns.col(3 * k + 1) = slope * (a[0] * x + a[1] * y);
      columns.col(3 * k + 2) = slope * (a[0] * y - a[1] * x);
    }
    for (int k = local_size() - 3; k < local_size(); ++k) columns.col(k) *= slope;
  }

  Functional deflection_of_vertex(int vertex) const { return {{of_vertex(vertex), 1}}; }
  /// HCT: ∂u along a direction.
  Functional slope_of_vertex(int vertex, const Eigen::Vector2d& direction) const;
  Functional slope_of_edge(int edge) const { return {{of_edge(edge), 1 / unit}}; }
  /// On the boundary ∫ ψu along an edge, ψ = 1 at this end of it, 0 at the other, linear between. Morley: of the linear u between the vertices. HCT: on the curve that the edge approximates, which stands
  /// out of it by s at its middle, where u + s ∂ₙu is taken for the deflection.
  Functional mean_deflection(int edge, int vertex) const;
  /// u within a cell.
  Functional deflection_at(int cell, const Barycentric& point) const;

  /// What the motions 1, (x − centre)/unit and (y − centre)/unit are: count() × 3.
  algebra::DenseMatrix motions() const;
  Eigen::Vector2d centre() const;  ///< mean of the nodes
};

/// Barycentric coordinates of a point in a cell.
Barycentric barycentric(const Triangle& triangle, const Eigen::Vector2d& x);

}  // namespace dotyk::plate
