#include "mesh/decomposition.hpp"
#include "mesh/submesh.hpp"

namespace dotyk::mesh {

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

}  // namespace dotyk::mesh
