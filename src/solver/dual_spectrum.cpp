#include "solver/dual_spectrum.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr int kSteps = 60;
/// A part of a unit vector in im P below it is rounding.
constexpr double kNoPart = 1e-10;

}  // namespace

algebra::SpectrumEnds dual_spectrum(const DualProblem& dual, const CoarseSpace& coarse, algebra::Ends ends,
                                    Monitor& monitor) {
  const Vector start = coarse.P(algebra::lanczos_start(dual.rows()));
  if (!(start.norm() > kNoPart)) return {};
  const auto PF = [&](const Vector& v) {
    monitor.check();
    return coarse.P(dual.apply(v));
  };
  return algebra::lanczos(PF, coarse.P(start), kSteps, ends);
}

}  // namespace dotyk::solver
