#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "plate/element/element.hpp"

namespace dotyk::plate {

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
