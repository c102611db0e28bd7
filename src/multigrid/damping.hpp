// How far sweeps that each rank makes of its own may go.
#pragma once

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// The relaxation factor ω of Gauss and Seidel's sweeps of each rank's own rows; 1 on one rank. With A = A_local + A_between and D the diagonal of A, M of a sweep
/// has M + Mᵀ − A = (2/ω − 1) D − A_between; the sweep converges, and a cycle of it is definite, where that is (Baker, Falgout, Kolev and Yang, SIAM J. Sci.
/// Comput. 33 (2011), §4). ω is 2/(1 + c), at most 1, where c is 1.15 times ‖D^−1/2 A_between D^−1/2‖ as found by power iteration: below 1 where pieces are
/// large, up to 1.7 where most rows of a rank are beside others'. Collective.
double damping(Mat A);

}  // namespace dotyk::multigrid
