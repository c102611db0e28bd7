#pragma once

#include "scene/model/free_jumps.hpp"
#include "scene/model/row_builder.hpp"

namespace dotyk::scene {

/// Adds the rows of the newest contact of the model, one of Model::contacts. Normal ones: none where supports hold the normal on both
/// sides. Tangential ones: springs, a row for each free tangent of a node; for each cell of friction with an unknown along its tangents, a
/// node's surroundings where multipliers are nodal. No rows where the bound or coefficient is 0; rows that never slip where it is
/// infinite. The normal row of a friction point is its node's; of a cell (given friction only, whose bound does
/// not depend on it) that of the node with most weight in it. Throws InputError where nodes fixed on both sides lie inside each other.
void add_contact_rows(const Scene& scene, const Contact& contact, const FreeJumps& jumps, RowBuilder& builder, Model& model);

}  // namespace dotyk::scene
