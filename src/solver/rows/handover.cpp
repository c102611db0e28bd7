#include "solver/rows/handover.hpp"

#include <vector>

#include "base/text.hpp"
#include "problem/uniqueness.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/newton_stepper.hpp"
#include "solver/pieces/piece_search.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/projection.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

constexpr int kNewtonSteps = 12;  // from the point of a programme
constexpr int kFromNear = 60;  // iterations of proximal from a solution with polygons for discs of friction

struct Alternative {
  std::shared_ptr<const RowMethod> method;
  int iterations;
};

std::vector<Alternative> alternatives(const problem::Problem& problem) {
  const auto proximal = std::make_shared<Proximal>();
  if (problem::has_coulomb(problem)) {
    const auto loop = std::make_shared<CoulombLoop>();
    loop->inner = std::make_shared<Newton>();
    return {{proximal, 60}, {loop, 100}, {std::make_shared<Psor>(), 5000}};
  }
  if (tells_springs(problem)) return {{proximal, 100}, {std::make_shared<ProjectedCg>(), 5000}};
  return {{proximal, 100}, {std::make_shared<Psor>(), 5000}};
}

/// A few Newton steps from a point of the search of pieces.
Attempt newton_from(const RowIteration& outer, const Settings& settings, Monitor& monitor) {
  return [&outer, &settings, &monitor](algebra::Vector& lambda, algebra::Vector& alpha) {
    RowIteration on(outer.problem, outer, settings, 1, monitor);
    on.begin_at(lambda, alpha);
    NewtonStepper stepper(on, false);
    while (!on.converged() && stepper.stuck() == 0 && on.next()) {
      stepper.step();
      on.record();
    }
    lambda = on.lambda(), alpha = on.alpha();
    return on.converged();
  };
}

/// The last one: takes the solution on whatever pieces, or refuses the problem where all are excluded. Says what it did.
std::string search(RowIteration& iteration, double tol) {
  iteration.monitor().phase("searching the pieces of the laws");
  InnerMonitor monitor(iteration.monitor());
  Settings settings;
  settings.tol = tol, settings.max_iterations = kNewtonSteps;
  const PieceSearch found = search_pieces(iteration.problem, iteration.condensed, newton_from(iteration, settings, monitor), iteration.monitor());
  const std::string programmes = text(found.programmes, found.programmes == 1 ? " linear programme" : " linear programmes");
  if (found.verdict == PieceSearch::Verdict::none) {
    if (const auto motion = stopped_by_friction_alone(iteration.problem))
      refuse_unbearable(*motion, programmes + " exclude all states of contact, stick and slip");
    return text("; ", programmes, " exclude all states of contact, stick and slip: there is no solution");
  }
  if (found.verdict == PieceSearch::Verdict::undecided) return found.programmes == 0 ? "" : text("; tried a search of pieces, ", programmes);
  const bool exact = found.verdict == PieceSearch::Verdict::found;
  iteration.grant(exact ? 1 : kFromNear);
  iteration.move_to(found.lambda, found.alpha);
  if (!exact) Proximal().iterate(iteration);
  else if (iteration.next()) iteration.record();
  return text(iteration.converged() ? "; solved by a search of pieces, " : "; tried a search of pieces, ", programmes, exact ? "" : ", and proximal from there");
}

}  // namespace

void hand_over(RowIteration& iteration, double tol) {
  if (problem::has_coulomb(iteration.problem)) require_bearable(iteration.problem, iteration.condensed, iteration.monitor());
  std::string tried = text("newton lost its way in ", iteration.iterations(), " iterations");
  for (const Alternative& next : alternatives(iteration.problem)) {
    if (iteration.monitor().stop()) break;
    const int before = iteration.iterations();
    iteration.grant(next.iterations);
    iteration.monitor().phase(tried + "; " + next.method->name());
    next.method->iterate(iteration);
    tried += text(iteration.converged() ? "; ended by " : "; tried ", next.method->name(), ", ", iteration.iterations() - before, " iterations");
    if (iteration.converged()) break;
  }
  if (!iteration.converged() && !iteration.monitor().stop() && problem::has_coulomb(iteration.problem)) tried += search(iteration, tol);
  iteration.remark(tried);
}

}  // namespace dotyk::solver
