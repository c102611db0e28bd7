#pragma once

#include <algorithm>
#include <vector>

#include "multigrid/slices.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Are the bodies refined by the ranks? Throws InputError where that is not so of all in the same way, or where there are more unknowns than can be numbered.
bool refined_by_ranks(const Model& model);

/// Assembles K of all bodies in slices: each rank its own rows, after it has refined its share of bodies that ranks refine. Numbering and rows are known.
void assemble_slices(Model& model);

/// The cells of bodies that ranks have refined, once more on all ranks: `make` on this one, by `what` on the others. `said`: as in multigrid::Visit. Returns what each
/// rank tells. Throws InputError where u does not lie with them.
std::vector<Lists> visit_refined(const Model& model, const problem::Displacement& u, multigrid::VisitFor what, decltype(multigrid::ShareMakers::visit) make, Lists said);
/// Does a rank own a cell of its share?
inline bool owns(const multigrid::VisitedCells& at, std::size_t first_node, const mesh::Mesh& mesh, int cell) {
  int least = at.number[first_node + static_cast<std::size_t>(mesh.cell(cell)[0])];
  for (int k = 1; k < mesh::nodes_of(mesh.element); ++k) least = std::min(least, at.number[first_node + static_cast<std::size_t>(mesh.cell(cell)[k])]);
  return least >= at.first && least < at.end;
}

}  // namespace dotyk::scene
