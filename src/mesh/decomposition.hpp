#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// The cells of a mesh shared out among pieces, each connected through facets: pieces hinged at a node (or, in
/// space, at an edge) would have more motions without strain than a rigid body has.
struct Pieces {
  std::vector<int> of_cell;  ///< which piece; numbered as their least cells are
  int count = 0;             ///< of pieces, none empty
  /// The cells of each piece, ascending.
  std::vector<std::vector<int>> cells() const;
};

/// The pieces that the mesh is in as it stands: one, where it is the mesh of one body.
Pieces pieces_of(const Mesh& mesh);

/// About `count` ≥ 1 pieces of like numbers of cells with few facets between them: METIS's k-way partition
/// (Karypis, Kumar 1998) of the graph of cells that share a facet, with a seed of its own, so that one mesh
/// always gives one result. A mesh in several parts is cut part by part, into one piece each at least; never more
/// pieces than cells. METIS may leave a piece empty or in two, so the number can differ from `count`.
Pieces decompose(const Mesh& mesh, int count);

/// The mesh's bounding box cut into boxes[i] ≥ 1 equal ones along axis i; a cell is in the box of the mean of its
/// nodes, on the plane between two in the upper one. What one box has of the mesh may be several pieces, or none.
Pieces decompose(const Mesh& mesh, const std::array<int, 3>& boxes);

/// `count` pieces shared out among bodies of so many cells each: one each first (so more than `count` where there
/// are more bodies), every further one where a piece has most cells; never more than cells.
std::vector<int> share_out(int count, const std::vector<int>& cells);

/// Some cells of a mesh with their nodes, as a mesh of its own without boundary parts.
struct Submesh {
  Mesh mesh;
  std::vector<int> cell;  ///< of the whole mesh, for each own cell
  std::vector<int> node;  ///< of the whole mesh, for each own node; ascending
};

/// `cells` in the order given.
Submesh submesh(const Mesh& whole, std::vector<int> cells);

/// The pieces of a mesh that are connected through facets, each a mesh of its own with its share of the boundary
/// parts (those of which it has no facet are left out); in the order of their first cells, cells and nodes as they were.
std::vector<Mesh> split(const Mesh& whole);

}  // namespace dotyk::mesh
