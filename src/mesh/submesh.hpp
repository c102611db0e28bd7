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

}  // namespace dotyk::mesh
