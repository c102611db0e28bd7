#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

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
