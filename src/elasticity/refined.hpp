#pragma once

#include <vector>

#include "algebra/coarse_functions.hpp"
#include "base/monitor.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Each cell cut into 4 in the plane, 8 in space, facets of parts likewise; the nodes of the mesh come first, and its `coarser` says what the
/// others lie between. Cells of order 2 are cut as their functions map them: curved sides stay the same curves.
/// `watch`: asked between the steps whether to stop; Interrupted is thrown then.
mesh::Mesh refined(const mesh::Mesh& mesh, Monitor* watch = nullptr);

/// What is known of a mesh's cells, a MaterialField or a LinearForce, of their pieces, where `finer` is the mesh refined once.
template <class Field>
Field of_pieces(const Field& field, const mesh::Mesh& mesh, const mesh::Mesh& finer) {
  const int each = finer.cell_count() / mesh.cell_count();
  std::vector<int> whole(static_cast<std::size_t>(field.varies() ? finer.cell_count() : 0));
  for (std::size_t c = 0; c < whole.size(); ++c) whole[c] = static_cast<int>(c) / each;
  return field.of(whole);
}

/// About how many bytes refined() needs while it works.
double refining_bytes(const mesh::Mesh& mesh);

/// Refines `times` times, and gives only the part of the result that consists of two layers of cells at the boundary; its `whole` tells of the rest. All cells about a
/// node of the first layer are in it. The mesh must be whole and in one piece.
struct NearBoundary {
  mesh::Mesh mesh;
  std::vector<int> parent;                   ///< the cell of the mesh before that each cell is a piece of
  std::vector<std::vector<double>> between;  ///< the coordinates of the meshes between the two, likewise of two layers, the finest first
};
NearBoundary refined_near_boundary(const mesh::Mesh& mesh, int times, Monitor* watch = nullptr);

/// The functions of coarser meshes, each by those of the mesh before it. Rows of the first are unknowns; other rows, and all columns, are components of the nodes
/// of coarser meshes, node by node. `unknown` as in Numbering, of the finest mesh, which has so many unknowns. Where a node of a coarser mesh has a prescribed
/// component, row and column are empty. A part of a mesh lacks nodes of the coarser meshes; none of their components is prescribed. Beyond the last coarser mesh that is known it is repeated.
std::vector<algebra::CoarseFunctions> coarse_functions(const mesh::Mesh& mesh, SharedList<int> unknown, int unknowns, int levels);

}  // namespace dotyk::elasticity
