// Of small levels each rank has all rows.
#pragma once

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// The rows of all ranks. Collective.
HalfRows all_rows(const Ranks& ranks, const HalfRows& own);
/// The same of coarse functions.
OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own);

}  // namespace dotyk::multigrid
