#pragma once

#include "multigrid/slices.hpp"

namespace dotyk::script {

/// What any rank makes of its cells when rank 0 visits them.
Lists visit(multigrid::VisitFor what, const multigrid::VisitedCells& at, const Lists& said);

}  // namespace dotyk::script
