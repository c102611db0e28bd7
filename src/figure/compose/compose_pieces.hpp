// The .pvtu of bodies that ranks refine: each rank writes its cells.
#pragma once

#include <string>

#include "multigrid/slices.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::figure {

/// Writes a.pvtu and the files a_0.vtu, a_1.vtu, … of the ranks, with the arrays of compose_grid(). Throws as write() for a GridFile, and InputError where
/// a rank cannot write.
void write_pieces(const scene::Solution& solution, const std::string& file);

/// What a rank makes of its cells for that.
Lists write_cells(const multigrid::VisitedCells& at, const Lists& said);

}  // namespace dotyk::figure
