#pragma once

#include "algebra/krylov/lanczos.hpp"
#include "solver/feti/coarse_space.hpp"
#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// The ends of the spectrum of PFP on the balanced multipliers im P, by at most 60 Lanczos steps there, one application
/// of F each (see algebra::lanczos): bound() is one of ‖PFP‖ from above, greatest/least with both ends asked for of
/// its condition number from below, which exceeds it by little where both have settled. Zeros where P is zero.
algebra::SpectrumEnds dual_spectrum(const DualProblem& dual, const CoarseSpace& coarse, algebra::Ends ends,
                                    Monitor& monitor);

}  // namespace dotyk::solver
