#pragma once

#include <vector>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// ‖v‖² of a displacement v (node × dimension) of a body (index in the scene) in the energy norm of the problem linearised
/// at `at`: ∫ ε(v):c:ε(v) + ∫ v·k v over its springs + Σ k weight (v·direction)² over the rows of its supports by laws that
/// spring there: elastic ones, and others (one-sided, unequal, capped, breaking) on the branch where their force follows
/// the displacement. Force·length.
double squared_energy_norm(const Solution& at, int body, const std::vector<double>& v);

/// Elastic laws of supports act at nodes: r(u(node)) times the node's length or area, where the law is ∫ r(u) v. The defect d, the difference on
/// each row, moves the discrete solution to u_h + w,
///   (K + Σ s_r B_rᵀB_r) w = Bᵀd,   s the stiffness of rows as the law has it at u_h, and great where they hold.
/// ‖w‖² = dᵀBw is what lumping costs: O(h⁴), but of springs softer than the body the greatest part, as they tilt with another second
/// moment than the part has. It is shared out to the cells of the parts' facets: body → cell; empty where no law is elastic.
std::vector<std::vector<double>> lumping_of_laws(const Solution& solution);

}  // namespace dotyk::scene
