#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Node → cells that contain it: cells[start[n]] … cells[start[n+1] − 1], ascending.
struct NodeCells {
  std::vector<int> start, cells;
};

inline NodeCells cells_of_nodes(const mesh::Mesh& mesh) {
  NodeCells result;
  const int per_cell = mesh.topology().nodes;
  result.start.assign(mesh.node_count() + 1, 0);
  for (int n : mesh.cells) ++result.start[n + 1];
  for (int i = 0; i < mesh.node_count(); ++i) result.start[i + 1] += result.start[i];
  result.cells.resize(mesh.cells.size());
  std::vector<int> fill(result.start.begin(), result.start.end() - 1);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    result.cells[fill[mesh.cells[k]]++] = static_cast<int>(k) / per_cell;
  return result;
}

}  // namespace dotyk::elasticity
