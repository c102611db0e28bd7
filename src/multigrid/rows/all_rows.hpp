// Gathers the rows of a small level on each rank.
#pragma once

#include <vector>

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// Joins the rows of all ranks, as if one rank had them all. Collective.
HalfRows all_rows(const Ranks& ranks, const HalfRows& own);
/// The same for the functions of a coarser mesh.
OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own);

/// The numbers `below`, without the spare ones, and `diagonal` of the HalfRows that all_rows() makes.
struct AllNumbers {
  std::vector<double> below, diagonal;
};
/// Only the numbers of all_rows(), for a matrix that has its pattern already. Collective.
AllNumbers all_numbers(const Ranks& ranks, const HalfRows& own);

}  // namespace dotyk::multigrid
