#pragma once

#include <optional>

#include "solver/active/linearisation.hpp"

namespace dotyk::solver {

/// Where one-sided rows are closed and bear nothing (below `noise`), for the sake of rigid motions that nothing else holds, the bodies
/// may have gone far for it, and rounding of the way costs digits of the stresses. The same linearisation with such rows held where
/// they are at rest, x_r = −c_r; nothing where there are none, or none of them is apart at rest.
std::optional<Linearisation> held_at_rest(const problem::Problem& problem, const Linearisation& closed, const algebra::Vector& lambda,
                                          const algebra::Vector& rho, const Noise& noise);

/// Does (λ, x), the solution of `rest` = held_at_rest(closed), obey the laws? `found`: the linearisation there.
bool obeys(const Linearisation& found, const Linearisation& rest, const Linearisation& closed, const algebra::Vector& lambda,
           const Noise& noise);

}  // namespace dotyk::solver
