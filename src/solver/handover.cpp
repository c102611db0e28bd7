#include "solver/handover.hpp"

#include <vector>

#include "base/text.hpp"
#include "solver/coulomb_loop.hpp"
#include "solver/newton.hpp"
#include "solver/projected_cg.hpp"
#include "solver/projection.hpp"
#include "solver/proximal.hpp"
#include "solver/psor.hpp"
#include "solver/treatable.hpp"

namespace dotyk::solver {
namespace {

struct Alternative {
  std::shared_ptr<const RowMethod> method;
  int iterations;
};

std::vector<Alternative> alternatives(const problem::Problem& problem) {
  const auto proximal = std::make_shared<Proximal>();
  if (bounds_depend_on_normal(problem)) {
    const auto loop = std::make_shared<CoulombLoop>();
    loop->inner = std::make_shared<Newton>();
    return {{proximal, 60}, {loop, 100}, {std::make_shared<Psor>(), 5000}};
  }
  if (tells_springs(problem)) return {{proximal, 100}, {std::make_shared<ProjectedCg>(), 5000}};
  return {{proximal, 100}, {std::make_shared<Psor>(), 5000}};
}

}  // namespace

void hand_over(RowIteration& iteration) {
  std::string tried = text("newton lost its way in ", iteration.iterations(), " iterations");
  for (const Alternative& next : alternatives(iteration.problem)) {
    if (iteration.monitor().stop()) break;
    const int before = iteration.iterations();
    iteration.grant(next.iterations);
    iteration.monitor().phase(tried + "; " + next.method->name());
    next.method->iterate(iteration);
    tried += text(iteration.converged() ? "; solved by " : "; tried ", next.method->name(), ", ", iteration.iterations() - before, " iterations");
    if (iteration.converged()) break;
  }
  iteration.remark(tried);
}

}  // namespace dotyk::solver
