// Gathers the rows of a small level on each rank.
#pragma once

#include <vector>

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// Joins the rows of all ranks, as if one rank had them all. Collective.
HalfRows all_rows(const Ranks& ranks, const HalfRows& own);
/// Joins the ranks' functions of a coarser mesh, as if one rank had them all. Collective.
OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own);

/// The numbers of the rows that all_rows() makes: their HalfRows::below, without its spare numbers, and their HalfRows::diagonal.
struct AllNumbers {
  std::vector<double> below, diagonal;
};
/// Only the numbers of all_rows(), for a matrix that has its pattern already. Collective.
AllNumbers all_numbers(const Ranks& ranks, const HalfRows& own);

}  // namespace dotyk::multigrid
