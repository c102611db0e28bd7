#include "solver/feti/dual_spectrum.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr int kSteps = 60;
/// A part of a unit vector in im P below it is rounding.
constexpr double kNoPart = 1e-10;

}  // namespace

algebra::SpectrumEnds dual_spectrum(const DualProblem& dual, const CoarseSpace& coarse, algebra::Ends ends,
                                    Monitor& monitor) {
  const Vector start = coarse.P(coarse.P(algebra::lanczos_start(dual.rows())));
  if (!(start.norm() > kNoPart)) return {};
  // What rounding brings in of im Q shall have an eigenvalue amid the others, not 0.
  const double middle = start.dot(dual.apply(start)) / start.squaredNorm();
  const auto PFP = [&](const Vector& v) -> Vector {
    monitor.check();
    const Vector Pv = coarse.P(v);
    return coarse.P(dual.apply(Pv)) + middle * (v - Pv);
  };
  return algebra::lanczos(PFP, start, kSteps, ends);
}

}  // namespace dotyk::solver
