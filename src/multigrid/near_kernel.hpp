#pragma once

#include "algebra/types.hpp"
#include "multigrid/embedding.hpp"
#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// Tells `matrix` the motions that take little energy: the columns of `modes`, made orthonormal, dependent ones left out.
void attach_near_kernel(Mat matrix, const Embedding& embedding, const algebra::DenseMatrix& modes);

}  // namespace dotyk::multigrid
