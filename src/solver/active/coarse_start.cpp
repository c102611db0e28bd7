#include "solver/active/coarse_start.hpp"

#include "base/error.hpp"
#include "problem/coarser.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/row_subset.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::Problem;

/// Smaller problems are solved by factors.
constexpr int kSmall = 5000;
/// Rows between closed ones touch up to this share of the greatest displacement.
constexpr double kTouches = 1e-9;

class CoarseRows : public RowSubset {
 public:
  CoarseRows(const Problem& problem, std::vector<char> kept) : RowSubset(problem) { take(std::move(kept)); }
};

}  // namespace

CoarseStart coarse_start(const Problem& problem, const Pdas& settings, Monitor& monitor) {
  CoarseStart start;
  if (problem.rows() == 0 || problem.unknowns() <= kSmall || problem::coarser_meshes(problem) == 0) return start;
  const problem::Coarser coarse = problem::coarser(problem);
  const CoarseRows rows(coarse.problem, coarse.kept);
  const Problem part = rows.restricted();
  Result result;
  try {
    Pdas begun = settings;
    const CoarseStart before = coarse_start(part, settings, monitor);
    begun.start = before.active, start.meshes = before.meshes + 1;
    result = part.unknowns() > kSmall ? solve(part, begun, monitor) : solve(part, {}, {before.active}, monitor);
  } catch (const InputError&) {  // said of the mesh that is given, where it is so there, too
  }
  if (!result.converged) return {};
  rows.extend(result);
  const Vector moved = coarse.problem.B * result.state.u, x = moved - coarse.problem.c;
  const double touches = -kTouches * moved.lpNorm<Eigen::Infinity>();
  start.active = result.active_sets.back();
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (!coarse.kept[r]) start.active[r] = x[r] >= touches;
  for (const auto& [group, k, first, n] : problem.friction_points())
    if (n >= 0 && !coarse.kept[n]) std::fill_n(start.active.begin() + first, group.components, start.active[n]);
  return start;
}

}  // namespace dotyk::solver
