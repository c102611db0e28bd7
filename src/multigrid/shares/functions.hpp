// Which process has which rows of the functions of coarser meshes.
#pragma once

#include "algebra/coarse_functions.hpp"
#include "multigrid/rows/own_functions.hpp"
#include "multigrid/shares/numbering.hpp"

namespace dotyk::multigrid {

AllOwnFunctions own_functions(const std::vector<algebra::CoarseFunctions>& functions, const Numbering& numbering, int rank);

}  // namespace dotyk::multigrid
