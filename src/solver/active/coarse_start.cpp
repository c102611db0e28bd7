#include "solver/active/coarse_start.hpp"

#include "algebra/direct/stop_factoring.hpp"
#include "base/stopwatch.hpp"
#include "problem/coarser.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/row_subset.hpp"

namespace dotyk::solver {
namespace {

using problem::Problem;

/// Smaller problems are solved by factors, but not where slices hide unknowns.
constexpr int kSmall = 5000;
/// Of a coarser solution: its contact forces are off by about as much because the mesh is coarse.
constexpr double kTolerance = 0.1;

}  // namespace

CoarseStart coarse_start(const Problem& problem, const Pdas& settings, Monitor& monitor) {
  if (problem.rows() == 0 || problem.all_unknowns() <= kSmall || problem::coarser_meshes(problem) == 0) return {};
  CoarseStart start;
  Stopwatch watch;
  monitor.phase("ordering");
  algebra::SymmetricMatrix stiffness;
  const auto rigid = [&] {
    const algebra::StopFactoring stop(monitor);
    return problem::rigid_motions(problem);
  }();
  start.stiffness = std::make_shared<HeldStiffness>(problem, rigid, settings.linear_or_factor(), monitor, &stiffness);
  start.ordering = watch.lap();
  monitor.phase("solving on coarser meshes");
  problem::Coarser coarse = problem::coarser(problem, std::move(stiffness));
  const RowSubset rows(coarse.problem, coarse.kept);
  if (rows.count() == 0) return start;
  const Problem part = rows.restricted();
  Result result;
  int meshes = 0;
  InnerMonitor inner(monitor);
  try {
    const CoarseStart before = coarse_start(part, settings, inner);
    Pdas begun = settings;
    begun.from = before.state, begun.stiffness = before.stiffness, begun.nested = false, begun.rough = true;
    begun.tol = std::max(begun.tol, kTolerance);
    meshes = before.meshes + 1;
    const bool small = part.unknowns() <= kSmall && !part.hides();
    result = small ? solve_chosen(part, by_factors(part), {}, inner) : solve(part, begun, inner);
  } catch (const SlowIterations&) {
    throw;  // on the finer mesh they would not be faster
  } catch (const InputError&) {  // said of the mesh that is given, where it is so there, too
  }
  monitor.check();
  if (!result.converged) return start;
  start.meshes = meshes;
  rows.extend(result);
  start.state = std::make_shared<problem::State>(start.stiffness->interpolated(coarse, result.state.u), coarse.finer_forces(result.state.lambda));
  return start;
}

}  // namespace dotyk::solver
