#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::solver {

/// The rows and columns `picked` (ascending) of a symmetric matrix, lower triangles both.
algebra::SparseMatrix principal(const algebra::SparseMatrix& lower, const std::vector<int>& picked);

/// The rows `rows` in the columns `columns` of a symmetric matrix given by its lower triangle; the two have no index in
/// common.
algebra::SparseMatrix coupling(const algebra::SparseMatrix& lower, const std::vector<int>& rows,
                               const std::vector<int>& columns);

}  // namespace dotyk::solver
