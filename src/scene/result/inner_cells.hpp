// What is asked of cells that ranks have refined. They refine them once more: each question costs as much.
#pragma once

#include <optional>
#include <vector>

#include "multigrid/slices.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

struct InnerEstimate {
  elasticity::ErrorParts parts;  ///< recovery, bulk and jump of all cells
  std::vector<double> solution;  ///< ∫ σ_h:c⁻¹:σ_h, by body
};
/// Of all ranks. Throws as visit_refined(). Where Hooke's tensor jumps, a region whose cells hang together only far from a rank's own ones counts as two there.
InnerEstimate inner_estimate(const Solution& solution);

struct InnerValues {
  mesh::Point displacement{};
  elasticity::Stress stress{};
};
/// At a point of a body; empty outside. Throws likewise.
std::optional<InnerValues> inner_values(const Solution& solution, int body, const mesh::Point& x);

/// What a rank makes of its cells for these.
Lists estimate_cells(const multigrid::VisitedCells& at, const Lists& said);
Lists values_at_point(const multigrid::VisitedCells& at, const Lists& said);

}  // namespace dotyk::scene
