#include "solver/core/default_method.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "multigrid/multigrid.hpp"
#include "problem/coarser.hpp"
#include "solver/core/near_rows.hpp"
#include "solver/core/turned_nodes.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"

namespace dotyk::solver {

namespace {

/// Below so many unknowns nothing takes long enough to be worth an estimate.
constexpr int kLarge = 8000;
/// Multigrid is taken where it is kFaster times as fast as factors, or kFactorIsKept times where all steps of a history use one factor.
constexpr double kFaster = 1.1, kFactorIsKept = 10;
constexpr double kOpening = 0.18;  ///< seconds that the library of multigrid takes to open

}  // namespace

bool multigrid_is_possible(const problem::Problem& problem) {
  const bool solid = std::all_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return bool(b.rigid); });
  return problem.unknowns() >= kLarge && problem.subdomains.empty() && solid && multigrid::available() && tells_springs(problem);
}

namespace {

/// Is multigrid faster by more than so many times, or memory too short for factors?
bool takes_multigrid(const problem::Problem& problem, double times = kFaster) {
  if (!multigrid_is_possible(problem)) return false;
  const Expected e = expected(problem);
  return e.factors.seconds > times * e.multigrid.seconds || !memory_for(e.factors.bytes);
}

/// The number of iterations a linear system beyond which factors are the faster way, once the library is open.
double most_iterations(const problem::Problem& problem) {
  constexpr double kShare = 0.4;  // of the seconds that the usual ones take
  const double usual = problem::coarser_meshes(problem) > 1 ? 25 : 45;
  const Expected e = expected(problem);
  return usual * (1 + std::max(0.0, e.factors.seconds / (e.multigrid.seconds - kOpening) - 1) / kShare);
}

/// Has nearly every row an unknown that no other row has, as those of mortar glue of order 1 do? Else the basis of rows fills up.
bool rows_stand_apart(const problem::Problem& problem) {
  constexpr double kNearly = 0.9;
  std::vector<int> rows_with(problem.unknowns(), 0);
  const auto for_each = [&](int r, auto&& work) {
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it)
      if (it.value() != 0) work(rows_with[it.col()]);
  };
  for (int r = 0; r < problem.rows(); ++r) for_each(r, [](int& count) { ++count; });
  int apart = 0;
  for (int r = 0; r < problem.rows(); ++r) {
    bool own = false;
    for_each(r, [&](int& count) { own = own || count == 1; });
    apart += own;
  }
  return apart >= kNearly * problem.rows();
}

}  // namespace

Expected expected(const problem::Problem& problem) {
  // Constants measured by scripts/studies/crossing.lua, for n unknowns and m points of contact with d components each. A factor takes 7.5 n² operations in space
  // and 210 n^1.5 in the plane. Contact takes 3 (dm)³ more for its dense matrices, or else a factor a step. Ordering grows with n.
  constexpr double kFlops = 1.25e10, kSteps = 8;
  constexpr int kRigidMotions = 6;
  const bool space = problem.blocks.front().rigid().cols() == kRigidMotions;
  const bool geometric = problem::coarser_meshes(problem) > 1;
  const bool quadratic = std::any_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.coarse.order == 2; });
  const double unknown = (space ? 4e-6 : 2.5e-6) * (geometric ? 1 : 6) * (quadratic ? 3 : 1);  // seconds of multigrid; twice as many entries and iterations
  double tangential = 0;
  for (const problem::FrictionGroup& group : problem.friction) tangential += group.components * group.points();
  const double n = problem.unknowns(), m = NearRows(problem, {}).count() * (1 - tangential / std::max(problem.rows(), 1)) * !all_linear(problem);
  const double solves = all_linear(problem) ? 0.6 : problem.friction.empty() ? 1 : 1.6;  // times as many iterations
  const auto factor_of = [&](double size) { return space ? 7.5 * size * size : 210 * std::pow(size, 1.5); };
  double factor = 0;  // of each body, or of all where they are glued
  for (const problem::Block& block : problem.blocks) factor += factor_of(block.size());
  if (problem.rows() > 0 && all_linear(problem)) factor = factor_of(n);
  const double rows = (space ? 81 : 24) * m * m * m, each = problem.friction.empty() ? kSteps * factor_of(n) : INFINITY;
  const double factor_bytes = space ? 200 * std::pow(n, 4.0 / 3) : 60 * n * std::log2(std::max(n, 2.0));
  return {{(space ? 6e-6 : 1e-6) * n + std::min(factor + rows, each) / kFlops, factor_bytes + problem::dense_bytes(m)},
          {kOpening + unknown * n * solves, (space ? 1000 : 500) * (geometric ? 1 : 1.8) * n}};
}

DefaultMethod default_method(const problem::Problem& problem) {
  if (takes_multigrid(problem)) return DefaultMethod::multigrid;
  if (problem.rows() == 0) return DefaultMethod::linear;
  if (!problem.friction.empty() || !tells_springs(problem)) return DefaultMethod::newton;
  constexpr int kMany = 3000, kShare = 10, kFew = 150;
  if (problem.rows() >= kFew && all_linear(problem) && rows_stand_apart(problem)) return DefaultMethod::held;
  return problem.rows() > kMany && kShare * problem.rows() > problem.unknowns() ? DefaultMethod::held : DefaultMethod::pdas;
}

namespace {

/// By newton or pdas; `by_default` as default_method() says.
Result run(const problem::Problem& problem, DefaultMethod by_default, Beginning from, Monitor& monitor, std::optional<bool> condensed = {}) {
  if (by_default == DefaultMethod::held) by_default = DefaultMethod::pdas;
  if (by_default == DefaultMethod::multigrid) by_default = problem.friction.empty() ? DefaultMethod::pdas : DefaultMethod::newton;
  if (by_default == DefaultMethod::newton) return Method(Newton{}).run(problem, std::move(from), monitor);
  Pdas pdas;
  pdas.reduced = condensed.value_or(by_default == DefaultMethod::pdas);
  pdas.interior = !pdas.reduced && condensed;
  return Method(pdas).run(problem, std::move(from), monitor);
}

/// Not converged, with the reason, where iterations come to no rest, linear systems are not solved by them, or the library cannot be used.
Result run_held(const problem::Problem& problem, bool by_multigrid, Beginning from, Monitor& monitor) {
  Pdas pdas = by_multigrid ? Multigrid() : Pdas();
  if (by_multigrid) pdas.linear = multigrid(Levels::meshes, most_iterations(problem));
  pdas.reduced = false;
  Result failed;
  try {
    return Method(pdas).run(problem, {std::move(from.start), nullptr, std::move(from.from)}, monitor);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    failed.reason = error.what();
  }
  return failed;
}

/// On the rows that may close; nothing where they do not hold the bodies, or come to no end.
std::optional<Result> run_near(NearRows near, Beginning from, Monitor& monitor) {
  problem::Clock before;
  const auto condenser = std::make_shared<problem::Condenser>();
  for (;;) try {
      const problem::Problem part = near.restricted();
      Beginning beginning = near.restricted(from);
      beginning.condenser = condenser;
      Result result = run(part, default_method(part), std::move(beginning), monitor);
      near.extend(result);
      result.clock.add_solve(before);
      if (!result.converged && !monitor.stop()) return std::nullopt;
      const std::vector<char> kept = near.kept();
      if (!result.converged || !near.join(result.state.u)) return result;
      condenser->grow(near.places(kept));
      before = result.clock;
      from = {result.active_sets.back(), nullptr, nullptr};
    } catch (const InputError&) {
      return std::nullopt;
    }
}

/// With rows that turned nodes make unnecessary left out; nothing where there are none, or where that does not solve it.
std::optional<Result> run_turned(const problem::Problem& problem, const Beginning& from, Monitor& monitor) {
  Stopwatch watch;
  const TurnedNodes nodes(problem);
  if (nodes.none()) return std::nullopt;
  try {
    const problem::Problem turned = nodes.turned();
    const double before = watch.lap();
    Result result = solve(turned, {}, nodes.turned(from), monitor);
    watch.lap();
    nodes.extend(result);
    result.clock.assembly += before, result.clock.recover += watch.lap();
    if (result.converged || monitor.stop()) return result;
  } catch (const InputError&) {  // said anew of the problem as it was given
  }
  return std::nullopt;
}

/// Not held on all unknowns.
Result run_otherwise(const problem::Problem& problem, DefaultMethod by_default, Beginning from, Monitor& monitor, std::optional<bool> condensed) {
  if (problem.rows() == 0) return solve_linear(problem, {}, monitor);
  if (!from.condenser && !condensed) {
    NearRows near(problem, from.start);
    if (!near.all())
      if (auto result = run_near(std::move(near), from, monitor)) return *std::move(result);
  }
  return run(problem, by_default, std::move(from), monitor, condensed);
}

}  // namespace

Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor, std::optional<bool> condensed) {
  if (method) {
    const bool linear = problem.rows() == 0 && !method.takes_linear() && !method.decomposition();
    return linear ? solve_linear(problem, method.ordering(), monitor) : method.run(problem, std::move(from), monitor);
  }
  if (!from.condenser && !condensed && !slices(problem))  // whose blocks it would put together
    if (auto result = run_turned(problem, from, monitor)) return *std::move(result);
  const DefaultMethod by_default = default_method(problem);
  Result before;
  const bool by_multigrid = by_default == DefaultMethod::multigrid && (!from.condenser || takes_multigrid(problem, kFactorIsKept));
  if (!condensed && (by_multigrid || (by_default == DefaultMethod::held && !from.condenser))) {
    before = run_held(problem, by_multigrid, from, monitor);
    if (before.converged || monitor.stop()) return before;
  }
  std::string tried = before.reason.empty() ? "" : "; before, on all unknowns: " + before.reason;
  try {
    Result result = run_otherwise(problem, by_default, from, monitor, condensed);
    result.reason += tried;
    if (!tried.empty()) result.clock.add_solve(before.clock);
    return result;
  } catch (const MemoryShort& error) {  // the orderings say so, where the rule did not
    if (!condensed && !by_multigrid && multigrid_is_possible(problem)) {
      before = run_held(problem, true, std::move(from), monitor);
      if (before.converged || monitor.stop()) return before;
      tried = "; by multigrid: " + before.reason;
    }
    throw MemoryShort(error.what() + tried);
  }
}

}  // namespace dotyk::solver
