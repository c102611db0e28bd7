#include <algorithm>

#include "mesh/facet_table.hpp"

namespace dotyk::mesh {

std::vector<int> facet_neighbours(const Mesh& mesh) {
  const FacetTable table(mesh);
  const int facets = mesh.topology().facets;
  std::vector<int> neighbour(static_cast<std::size_t>(mesh.cell_count()) * facets, -1);
  const auto meet = [&](Facet f, Facet g) {
    int& cell = neighbour[static_cast<std::size_t>(f.cell) * facets + f.local];
    if (cell < 0) cell = g.cell;
  };
  parallel_ranges(mesh.node_count(), threads_for(mesh.cell_count(), FacetTable::kFewCells), [&](int, int first, int end) {
    for (int node = first; node < end; ++node) table.pairs(node, [&](Facet f, Facet g) { meet(f, g), meet(g, f); });
  });
  return neighbour;
}

std::vector<Facet> boundary(const Mesh& mesh) {
  if (mesh.whole) return mesh.whole->boundary;
  const std::vector<int> neighbour = facet_neighbours(mesh);
  const int facets = mesh.topology().facets;
  std::vector<Facet> result;
  for (std::size_t k = 0; k < neighbour.size(); ++k)
    if (neighbour[k] < 0) result.push_back({static_cast<int>(k) / facets, static_cast<int>(k) % facets});
  return result;
}

std::vector<char> flag_nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  std::vector<char> flagged(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Facet f : facets)
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) flagged[mesh.facet_node(f, k)] = 1;
  return flagged;
}

std::vector<int> cells_at(const Mesh& mesh, const std::vector<char>& flagged) {
  const int per_cell = nodes_of(mesh.element);
  std::vector<int> cells;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (std::any_of(mesh.cell(c), mesh.cell(c) + per_cell, [&](int node) { return flagged[node] != 0; })) cells.push_back(c);
  return cells;
}

std::vector<char> surrounded_cells(const Mesh& mesh) {
  std::vector<char> cells(static_cast<std::size_t>(mesh.cell_count()), !mesh.whole);
  if (mesh.whole)
    for (const int c : cells_at(mesh, flag_nodes(mesh, mesh.whole->boundary))) cells[c] = 1;
  return cells;
}

std::vector<Facet> select(const Mesh& mesh,
                          const std::function<bool(const Point&, const Point&)>& chosen) {
  std::vector<Facet> result;
  for (const Facet f : boundary(mesh))
    if (chosen(mesh.facet_centre(f), unit(mesh.facet_area_vector(f)))) result.push_back(f);
  return result;
}

}  // namespace dotyk::mesh
