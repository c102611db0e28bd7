#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// The rows of so many nodes from `first` on. `slot`: the row, by the numbers of Numbering, of each unknown of the lower triangle.
HalfRows own_rows(const algebra::SparseMatrix& lower, const std::vector<int>& slot, int block, int first, int nodes);

/// Entries of the lower triangle of a symmetric matrix, rows and columns by the numbers of Numbering.
struct Entries {
  std::vector<int> rows, columns;
  std::vector<double> values;
};
/// Adds those that are stored here. The pattern must have them.
void add(HalfRows& rows, const Entries& entries);

/// Sets the diagonal of those idle rows, counted as in Numbering, that are own.
void fill_idle(HalfRows& rows, const std::vector<int>& idle, double number);

/// Joins the rows of all ranks, as if one rank had them all. Collective.
HalfRows all_rows(const Ranks& ranks, const HalfRows& own);
/// Joins the ranks' functions of a coarser mesh, as if one rank had them all. Collective.
OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own);

/// The matrix entries of the rows that all_rows() makes: HalfRows::below without the kSpare numbers at its end, and HalfRows::diagonal.
struct AllNumbers {
  std::vector<double> below, diagonal;
};
/// Only the numbers of all_rows(), for a matrix that has its pattern already. Collective.
AllNumbers all_numbers(const Ranks& ranks, const HalfRows& own);

}  // namespace dotyk::multigrid
