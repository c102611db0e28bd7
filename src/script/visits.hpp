#pragma once

#include "multigrid/slices.hpp"

namespace dotyk::script {

/// What any rank makes of its cells when rank 0 visits them.
multigrid::VisitCells visit(multigrid::VisitFor what);

}  // namespace dotyk::script
