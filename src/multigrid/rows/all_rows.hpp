// Gathers the rows of a small level on each rank.
#pragma once

#include <vector>

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// The rows of all ranks as those of one. Collective.
HalfRows all_rows(const Ranks& ranks, const HalfRows& own);
/// The same of coarse functions.
OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own);

/// HalfRows::below, without spare numbers, and HalfRows::diagonal of all_rows().
struct AllNumbers {
  std::vector<double> below, diagonal;
};
/// Collective.
AllNumbers all_numbers(const Ranks& ranks, const HalfRows& own);

}  // namespace dotyk::multigrid
