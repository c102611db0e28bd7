#include "mesh/submesh.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::mesh {

namespace {

/// Gives the nodes of the cells, numbered as in a mesh of so many nodes, numbers of their own.
void number_nodes(int nodes_of_whole, Submesh& piece) {
  std::vector<int>& cells = piece.mesh.cells;
  constexpr std::size_t kLarge = 16;  // a piece of more than such a part of the mesh: to look at all nodes is faster than to sort its own
  if (kLarge * cells.size() < static_cast<std::size_t>(nodes_of_whole)) {
    piece.node = cells;
    std::sort(piece.node.begin(), piece.node.end());
    piece.node.erase(std::unique(piece.node.begin(), piece.node.end()), piece.node.end());
    for (int& n : cells) n = static_cast<int>(std::lower_bound(piece.node.begin(), piece.node.end(), n) - piece.node.begin());
    return;
  }
  std::vector<int> number(static_cast<std::size_t>(nodes_of_whole), -1);
  for (const int n : cells) number[n] = 0;
  for (int n = 0; n < nodes_of_whole; ++n)
    if (number[n] == 0) number[n] = static_cast<int>(piece.node.size()), piece.node.push_back(n);
  for (int& n : cells) n = number[n];
}

}  // namespace

Submesh submesh(const Mesh& whole, std::vector<int> cells) {
  Submesh piece;
  piece.mesh.element = whole.element;
  const int per_cell = whole.topology().nodes, dim = whole.dimension();
  piece.mesh.cells.reserve(cells.size() * per_cell);
  for (const int c : cells) piece.mesh.cells.insert(piece.mesh.cells.end(), whole.cell(c), whole.cell(c) + per_cell);
  number_nodes(whole.node_count(), piece);
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
