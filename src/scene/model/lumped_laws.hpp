#pragma once

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// Elastic laws of supports act at nodes: r(u(node)) times the node's length or area, where the law is ∫ r(u) v. The defect d, the difference on
/// each row, moves the discrete solution to u_h + w,
///   (K + Σ s_r B_rᵀB_r) w = Bᵀd,   s the stiffness of rows as the law has it at u_h, and great where they hold.
/// ‖w‖² = dᵀBw is what lumping costs: O(h⁴), but of springs softer than the body the greatest part, as they tilt with another second
/// moment than the part has. It is shared out to the cells of the parts' facets: body → cell; empty where no law is elastic.
std::vector<std::vector<double>> lumping_of_laws(const Solution& solution);

}  // namespace dotyk::scene
