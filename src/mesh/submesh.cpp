#include "mesh/submesh.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/decomposition.hpp"

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

std::vector<Mesh> split(const Mesh& whole) {
  const Pieces pieces = pieces_of(whole);
  std::vector<Mesh> result;
  std::vector<int> place(whole.cell_count());
  for (const std::vector<int>& cells : pieces.cells()) {
    for (std::size_t k = 0; k < cells.size(); ++k) place[cells[k]] = static_cast<int>(k);
    result.push_back(submesh(whole, cells).mesh);
  }
  for (const auto& [name, facets] : whole.parts)
    for (const Facet f : facets) result[pieces.of_cell[f.cell]].parts[name].push_back({place[f.cell], f.local});
  return result;
}

Mesh keep(const Mesh& mesh, const std::function<bool(const Point&)>& chosen, const std::string& new_part) {
  std::vector<int> cells, own(mesh.cell_count(), -1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (chosen(mesh.cell_centre(c))) {
      own[c] = static_cast<int>(cells.size());
      cells.push_back(c);
    }
  if (cells.empty()) throw InputError(text("no cell is kept: the function is false at the centre of each of the ", mesh.cell_count()));
  Submesh sub = submesh(mesh, std::move(cells));
  Mesh& kept = sub.mesh;
  for (const auto& [name, facets] : mesh.parts) {
    std::vector<Facet> left;
    for (const Facet f : facets)
      if (own[f.cell] >= 0) left.push_back({own[f.cell], f.local});
    if (!left.empty()) kept.parts[name] = std::move(left);
  }
  std::vector<Facet> old;
  for (const Facet f : boundary(mesh))
    if (own[f.cell] >= 0) old.push_back({own[f.cell], f.local});
  std::vector<Facet>& bare = kept.parts[new_part];
  for (const Facet f : boundary(kept))
    if (!std::binary_search(old.begin(), old.end(), f)) bare.push_back(f);
  if (bare.empty()) kept.parts.erase(new_part);
  return std::move(kept);
}

}  // namespace dotyk::mesh
