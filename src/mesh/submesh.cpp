#include "mesh/submesh.hpp"

#include <algorithm>

namespace dotyk::mesh {

Submesh submesh(const Mesh& whole, std::vector<int> cells) {
  Submesh piece;
  piece.mesh.element = whole.element;
  const int per_cell = whole.topology().nodes, dim = whole.dimension();
  piece.mesh.cells.reserve(cells.size() * per_cell);
  for (const int c : cells) piece.mesh.cells.insert(piece.mesh.cells.end(), whole.cell(c), whole.cell(c) + per_cell);
  piece.node = piece.mesh.cells;
  std::sort(piece.node.begin(), piece.node.end());
  piece.node.erase(std::unique(piece.node.begin(), piece.node.end()), piece.node.end());
  for (int& n : piece.mesh.cells)
    n = static_cast<int>(std::lower_bound(piece.node.begin(), piece.node.end(), n) - piece.node.begin());
  piece.mesh.coordinates.reserve(piece.node.size() * dim);
  for (const int n : piece.node)
    piece.mesh.coordinates.insert(piece.mesh.coordinates.end(), whole.node(n), whole.node(n) + dim);
  piece.cell = std::move(cells);
  return piece;
}

}  // namespace dotyk::mesh
