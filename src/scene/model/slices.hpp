#pragma once

#include <algorithm>
#include <vector>

#include "elasticity/share.hpp"
#include "multigrid/slices.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Are the bodies refined by the ranks? Throws InputError where that is not so of all in the same way, or where there are more unknowns than can be numbered.
bool refined_by_ranks(const Model& model);

/// Assembles K of all bodies in slices, each rank its own rows. Bodies with `refine` are refined by the ranks first. The model's numbering and rows must be there.
void assemble_slices(Model& model);

/// The cells of bodies that ranks have refined, once more on all ranks: `make` on this one, by `what` on the others. `said`, `nodes`: as in multigrid::Visit. Returns what each
/// rank tells. Throws InputError where u does not lie with them.
std::vector<Lists> visit_refined(const Model& model, const problem::Displacement& u, multigrid::VisitFor what, multigrid::VisitCells make, Lists said, std::vector<int> nodes = {});
/// Does a rank own a cell of its share?
inline bool owns(const multigrid::VisitedCells& at, std::size_t first_node, const mesh::Mesh& mesh, int cell) {
  int least = at.number[first_node + static_cast<std::size_t>(mesh.cell(cell)[0])];
  for (int k = 1; k < mesh::nodes_of(mesh.element); ++k) least = std::min(least, at.number[first_node + static_cast<std::size_t>(mesh.cell(cell)[k])]);
  return least >= at.first && least < at.end;
}
/// Calls visit(cells, u, its first node) for each body of a rank's share.
template <class Visit>
void each_body(const multigrid::VisitedCells& at, const Visit& visit) {
  std::size_t first = 0;
  for (const elasticity::ShareCells& cells : static_cast<const elasticity::RefinableShare&>(at.cells).bodies()) {
    const auto begin = at.u.begin() + static_cast<std::ptrdiff_t>(first) * cells.mesh.dimension();
    visit(cells, std::vector<double>(begin, begin + std::ssize(cells.mesh.coordinates)), first);
    first += static_cast<std::size_t>(cells.mesh.node_count());
  }
}

}  // namespace dotyk::scene
