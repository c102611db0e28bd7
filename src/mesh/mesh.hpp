#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/buckets.hpp"
#include "mesh/element.hpp"
#include "mesh/point.hpp"

namespace dotyk::mesh {

/// One side of a cell on the boundary.
struct Facet {
  int cell;
  int local;  ///< which facet of the cell, as in ElementTopology::facet_nodes
  auto operator<=>(const Facet&) const = default;
};

/// The coarser mesh that a mesh refines, as far as its nodes say: those of the coarser mesh are among them, and every other one is taken as the mean of
/// the ends of an edge, the corners of a face or of a cell of it, wherever gradings, transform() or curved sides have put it. Whatever renumbers
/// nodes leaves it empty.
struct Coarser {
  Buckets means;  ///< node → the coarser mesh's nodes whose mean it is: itself, or 2, 4 or 8
  int node_count = 0;
  std::shared_ptr<const Coarser> next;  ///< that mesh's own
};

/// What a part of a mesh, the cells near its boundary, knows of the whole.
struct Whole {
  std::vector<Facet> boundary;      ///< the whole mesh's, by cell; all belong to cells that are here
  std::vector<int> nodes;           ///< how many the whole mesh has, then each coarser whole mesh
  std::int64_t cells = 0;           ///< of the whole mesh
};

/// A conforming mesh of one cell type, with named boundary parts; or a part of one.
struct Mesh {
  Element element = Element::triangle_p1;
  std::vector<double> coordinates;  ///< dimension × node_count, node by node; the user's length unit
  std::vector<int> cells;           ///< nodes per cell × cell_count, cell by cell
  std::map<std::string, std::vector<Facet>> parts;
  std::shared_ptr<const Coarser> coarser = nullptr;  ///< where it is known
  std::shared_ptr<const Whole> whole = nullptr;      ///< null: this mesh is whole
  /// Sizes of `coordinates` and `cells` as a grid, or what keeps its cells together (order 2, cutting), made them. While they are these, the mesh is in one piece
  /// (see pieces_of), with no cell twice and no node without a cell; nodes may have moved. Code that exchanges cells must clear it.
  std::array<std::size_t, 2> generated{};
  bool one_piece() const { return generated == std::array{coordinates.size(), cells.size()} && !cells.empty(); }

  const ElementTopology& topology() const { return mesh::topology(element); }
  int dimension() const { return dimension_of(element); }
  int node_count() const { return static_cast<int>(coordinates.size()) / dimension(); }
  int cell_count() const { return static_cast<int>(cells.size()) / nodes_of(element); }
  const double* node(int i) const { return &coordinates[static_cast<std::size_t>(i) * dimension()]; }
  const int* cell(int c) const { return &cells[static_cast<std::size_t>(c) * nodes_of(element)]; }

  Point point(int i) const {
    const double* x = node(i);
    return {x[0], x[1], dimension() == 3 ? x[2] : 0};
  }
  Point mean(const int* nodes, int count) const;
  Point cell_centre(int c) const;
  Box box() const;  ///< around the nodes
  /// Greatest extent of the nodes along a coordinate axis.
  double size() const;

  /// Node k of a facet, k < nodes_per_facet.
  int facet_node(Facet f, int k) const {
    return cell(f.cell)[topology().facet_nodes[f.local][k]];
  }
  Point facet_centre(Facet f) const;
  /// ∫n, the outward normal times length (2-D) or area (3-D; of the mean plane for quadrilaterals); of a curved facet that is
  /// less than its length or area.
  Point facet_area_vector(Facet f) const;
};

/// d/dt of facet_area_vector() of a facet of order 1 where nodes move with the velocity V (node × dimension).
Point facet_area_derivative(const Mesh& mesh, const std::vector<double>& V, Facet f);

/// The number of nodes of each known coarser mesh, the finest of them first; for a part of a mesh, those of the whole meshes.
std::vector<int> coarser_nodes(const Mesh& mesh);

/// Node → the cells that have it, ascending.
Buckets cells_of_nodes(const Mesh& mesh);

/// Cell × facets of a cell → the cell on the other side, or -1 on the boundary. Where more than two cells
/// share a facet, each has one of the others.
std::vector<int> facet_neighbours(const Mesh& mesh);

/// All boundary facets (those that belong to one cell only), by cell; for a part of a mesh, those of the whole.
std::vector<Facet> boundary(const Mesh& mesh);

/// Flags the nodes of these facets.
std::vector<char> flag_nodes(const Mesh& mesh, const std::vector<Facet>& facets);

/// The cells that have a flagged node, ascending.
std::vector<int> cells_at(const Mesh& mesh, const std::vector<char>& flagged);

/// Flags the cells for whose nodes the mesh has all cells about them. In a part of a mesh these are the cells at the boundary of the whole; in a whole mesh all.
std::vector<char> surrounded_cells(const Mesh& mesh);

/// The boundary facets that `chosen(centre, unit outward normal)` accepts.
std::vector<Facet> select(const Mesh& mesh,
                          const std::function<bool(const Point&, const Point&)>& chosen);

/// Throws InputError where a cell is inverted or flat (naming it and its first
/// node), repeated, a coordinate is not finite, or a node belongs to no cell. `what` names the mesh in the message.
void check(const Mesh& mesh, const std::string& what);

/// Twice the area (triangle), the volume times six (tetrahedron), the least corner Jacobian (quadrilateral), or the least one
/// at the places of nodes of order 2 (hexahedron, cells of second order): positive for a valid cell.
double least_jacobian(const Mesh& mesh, int cell);

/// Moves the flagged nodes, or all where `flagged` is empty, to `map(x)`. Throws InputError where a cell inverts or a
/// coordinate is not finite, and then leaves the mesh as it was.
void transform(Mesh& mesh, const std::function<Point(const Point&)>& map, const std::vector<char>& flagged = {});

/// The cells whose centre `chosen` accepts, with what is left of the parts; the facets laid bare become part
/// `new_part` (added to one of that name). Cells and nodes keep their order. Throws InputError where no cell is left.
Mesh keep(const Mesh& mesh, const std::function<bool(const Point&)>& chosen, const std::string& new_part);

}  // namespace dotyk::mesh
