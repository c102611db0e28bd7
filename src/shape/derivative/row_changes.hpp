#pragma once

#include "scene/result/solution.hpp"

namespace dotyk::shape {

/// How the nodes of a scene's bodies move: body → node × dimension, length per unit of the design variable; empty: the
/// body rests.
using Velocities = std::vector<std::vector<double>>;

/// What the rows of B give to the derivative of a state when nodes move. Contacts keep their pairs of nodes, what was
/// added to their gaps and friction's bounds per length or area; glued nodes keep their axes.
struct RowChanges {
  algebra::Vector c;      ///< c' − B'u, one a row
  std::vector<std::vector<double>> force;  ///< B'ᵀλ: body → node × dimension, prescribed components included
  algebra::Vector bound;  ///< of each point of given friction, at the first of its rows; 0 on all others
};

/// Throws InputError where a part that moves is in contact by p1_p0 multipliers, whose rows' derivatives are not known,
/// or before a RigidGap.
RowChanges row_changes(const scene::Solution& solution, const Velocities& velocities);

/// d/dt of the weights of a contact's rows (index in the scene): length or area, so that with a pressure p = λ/weight
/// p' = (λ' − p weight')/weight. Against a rigid shape all facets of the part count, else those of the common surface.
std::vector<double> weight_changes(const scene::Solution& solution, int contact, const Velocities& velocities);

}  // namespace dotyk::shape
