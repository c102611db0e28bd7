// The relaxation of Gauss-Seidel sweeps in which each rank updates its own rows only.
#pragma once

#include <vector>

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// The relaxation factor ω of such sweeps; 1 on one rank. A = A_local + A_between, where A_between couples rows of different ranks, and D is the diagonal of A.
/// The matrix M of a sweep satisfies M + Mᵀ − A = (2/ω − 1) D − A_between. If this is positive definite, the sweep converges and a V-cycle of it is positive
/// definite (Baker, Falgout, Kolev and Yang, SIAM J. Sci. Comput. 33 (2011), §4). So ω = min(1, 2/(1 + c)) where c is the greatest eigenvalue of
/// D^−1/2 A_between D^−1/2, by Lanczos and 3 % more. c is below 1 if pieces are large, and up to 3.3 if most rows of a rank are coupled to rows of others.
/// `solved`: rows of this rank, counted from its first, that the smoother solves exactly as well; they are left out of the eigenvalue problem.
/// Collective.
double damping(Mat A, const std::vector<int>& solved = {});

}  // namespace dotyk::multigrid
