#include "solver/core/verdict.hpp"

#include "solver/core/settle.hpp"

namespace dotyk::solver {

namespace {

using problem::Problem;
using problem::Residual;

/// Of forces; states that are further off, by rounding or by a tol that asks for no more, are no result.
constexpr double kMostGranted = 0.1;
/// So many times the rounding of one product each a direct solution may leave of equilibrium.
constexpr double kRoundings = 1000;

void require_finite(const Problem& problem, const Result& result, const Residual& r) {
  const double sum = r.energy + problem::friction_energy(problem, result.state) + r.equilibrium +
                     r.penetration + r.complementarity + r.law;
  const problem::Displacement& u = result.state.u;
  const bool finite = u.there() ? std::isfinite(u.there()->moduli()) : u.here().allFinite();
  if (finite && result.state.lambda.allFinite() && std::isfinite(sum)) return;
  throw std::runtime_error(
      "the solution has values beyond the range of numbers: stiffness, loads or sizes are too large or too "
      "small; choose units in which they are moderate");
}

/// The equilibrium residual less what rounding of motions as a whole makes of it, where that is what is too great: the
/// reason then says whose stresses suffer.
double honest_equilibrium(const Problem& problem, double raw, double allowed, Result& result) {
  if (raw <= allowed || raw > kMostGranted || problem.hides()) return raw;
  const problem::MotionResidual motion = problem::motion_residual(problem, result.state);
  const double honest = std::max(motion.beyond, motion.resultants);
  if (motion.most >= 0 && honest <= allowed)
    result.reason += text("; '", problem.blocks[motion.most].name, "' moves as a whole far more than it deforms: rounding "
                          "of the displacements leaves its stresses uncertain by about ", raw);
  return honest;
}

/// What the method said of its end it said by a test of its own, which is not the last word: told as its words, not as the case.
void refuse(std::string reason, Result& result) {
  result.converged = false;
  result.reason = std::move(reason) + (result.reason.empty() ? "" : "; the method's own test was met: " + result.reason);
}

void refuse_residuals(const Problem& problem, const Residual& r, Result& result) {
  const double asked = std::max(result.noise, std::min(result.asked, kMostGranted)), allowed = result.penalty || result.feti ? result.noise : asked;
  const double equilibrium = honest_equilibrium(problem, r.equilibrium, allowed, result);
  // A penalised state is off its laws by what the method says, and no more.
  double penalty = 0;
  if (result.penalty) {
    const problem::Measure measure(problem, result.state);
    for (int row = 0; row < problem.rows(); ++row) penalty = std::max(penalty, (1 + asked) * result.penalty->penetration / measure.length_of_row(row));
  }
  const double laws = result.penalty ? r.law : r.laws();
  const std::string unloaded = problem.loaded() ? "" : " (no load gives forces a scale: if they should vanish, take pdas, which ends exactly)";
  const std::string unexplained = (result.asked > kMostGranted ? text(", and beyond ", kMostGranted, " none is a solution, whatever tol") : ", which neither tol nor rounding explains") + unloaded;
  const char* far_apart = result.feti ? "stiffnesses, supports or sizes are too far apart for this decomposition, or tol is too great"
                                      : "stiffnesses, supports or sizes are too far apart (a material nearly incompressible, a spring nearly absent, cells "
                                        "nearly flat, a beam far stiffer than its cells' foundation)";
  if (equilibrium > allowed && result.asked > kMostGranted) refuse(text("the state is off equilibrium by ", equilibrium, unexplained), result);
  else if (equilibrium > allowed && equilibrium > kRoundings * problem::rounding_of_equilibrium(problem, result.state))
    refuse(text("the state is off equilibrium by ", equilibrium, ", more than rounding of its terms", unloaded, ": the method has not solved it, or ", far_apart), result);
  else if (equilibrium > allowed)
    refuse(text("rounding leaves a residual of ", equilibrium, " in equilibrium", unloaded, ": ", far_apart), result);
  else if (laws > std::max(asked, penalty))
    refuse(text("the state is off the laws of contact and supports by ", laws, unexplained), result);
}

/// A motion held by a part of the body's own stiffness is known to rounding over that part, whatever the residuals say:
/// a factor of K is no better.
void refuse_lost_motions(double softest, Result& result) {
  const double lost = std::numeric_limits<double>::epsilon() / softest;
  if (lost > result.noise) refuse(text("rounding may leave ", lost, " of a motion that supports hardly hold"), result);
}

std::size_t first_clause(const std::string& reason) { return std::min(reason.find("; "), reason.size()); }

}  // namespace

std::string ending(const Result& r) {
  const std::size_t end = first_clause(r.reason);
  return text(r.converged ? "converged: " : "NOT CONVERGED: ", r.reason.substr(0, end), " (", r.method, ", ", r.iterations,
              r.iterations == 1 ? " iteration)" : " iterations)", r.reason.substr(end));
}

std::string doubt(const Result& r) {
  return r.converged ? "" : "not converged: " + r.reason.substr(0, first_clause(r.reason));
}

Residual judge(const Problem& problem, Result& result, double softest) {
  const double lost = result.converged && result.state.lambda.allFinite() ? settle_on_springs(problem, result.noise, result.state) : 0;
  const Residual r = problem::residual(problem, result.state);
  require_finite(problem, result, r);
  if (result.converged && lost > result.noise) refuse(text("rounding may leave ", lost, " of a motion that springs alone hold"), result);
  if (result.converged) refuse_residuals(problem, r, result);
  if (result.converged) refuse_lost_motions(softest, result);
  return r;
}

}  // namespace dotyk::solver
