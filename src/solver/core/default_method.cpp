#include "solver/core/default_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
/// Multigrid is chosen where factors are estimated to take kFaster times as long, since its number of iterations is less certain. In a history, where one factor
/// serves all steps, they must take kFactorIsKept times as long.
constexpr double kFaster = 1.4, kFactorIsKept = 10;
constexpr double kOpening = 0.2;  ///< seconds that the library of multigrid takes to open

/// Whether memory suffices for the factors and a quarter more for other arrays. The bytes of expected() are within a sixth of what orderings predict.
bool factors_fit(const Expected& e) { return memory_for(1.25 * e.factors.bytes); }

/// Whether multigrid promises to be faster, or memory is too short for factors.
bool takes_multigrid(const problem::Problem& problem) {
  if (!multigrid_is_possible(problem)) return false;
  const Expected e = expected(problem);
  return e.factors.seconds > kFaster * e.multigrid.seconds || !factors_fit(e);
}

/// The same for a step of a history. Where its factor exists already, memory is no reason for multigrid.
bool takes_multigrid(const problem::Problem& problem, const problem::Condenser& condenser) {
  const Expected e = expected(problem);
  return e.factors.seconds > kFactorIsKept * e.multigrid.seconds || (!condenser.holds() && !factors_fit(e));
}

/// The number of iterations a linear system beyond which factors are the faster way, once the library is open. Infinite where memory is too short for them.
double most_iterations(const problem::Problem& problem) {
  const Expected e = expected(problem);
  if (!factors_fit(e)) return std::numeric_limits<double>::infinity();
  constexpr double kShare = 0.4;  // of the seconds that the usual ones take
  const double usual = problem::coarser_meshes(problem) > 1 ? 25 : 45;
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

bool multigrid_is_possible(const problem::Problem& problem) {
  const bool solid = std::all_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return bool(b.rigid); });
  return problem.unknowns() >= kLarge && problem.subdomains.empty() && solid && multigrid::available() && tells_springs(problem);
}

Expected expected(const problem::Problem& problem) {
  // Constants measured by scripts/studies/crossing.lua. n: unknowns; m: contact points with d components each. A factor takes 7.5 n² operations in space (order 2:
  // 10 n²) and 80 n^1.5 in the plane (order 2: 130 n^1.5). Frictionless contact adds 3 (dm)³ for dense matrices, or takes a factor a step. Ordering grows with n.
  constexpr double kFlops = 1.25e10, kSteps = 8, kFriction = 1.5;
  constexpr double kMultigrid[2][2][2] = {{{2.2e-6, 7e-6}, {4.8e-6, 9.6e-6}}, {{4e-6, 1.6e-5}, {4.8e-5, 4.8e-5}}};  // seconds an unknown: plane, space; order 1, 2; meshes, aggregates
  constexpr int kRigidMotions = 6;
  const bool space = problem.blocks.front().rigid().cols() == kRigidMotions;
  const bool geometric = problem::coarser_meshes(problem) > 1, linear = all_linear(problem), friction = !problem.friction.empty();
  const bool quadratic = std::any_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.coarse.order == 2; });
  double tangential = 0;
  for (const problem::FrictionGroup& group : problem.friction) tangential += group.components * group.points();
  const double n = problem.unknowns(), near = NearRows(problem, {}).count(), m = near * (1 - tangential / std::max(problem.rows(), 1)) * !linear;
  const double solves = linear ? 0.6 : friction ? 1.6 : 1;               // times as many iterations
  const double several_bodies = problem.blocks.size() > 1 ? 2 : 1;       // times the work of one
  const auto factor_of = [&](double size) { return space ? (quadratic ? 10 : 7.5) * size * size : (quadratic ? 130 : 80) * std::pow(size, 1.5); };
  const auto bytes_of = [&](double size) { return space ? 200 * std::pow(size, 4.0 / 3) : 60 * size * std::log2(std::max(size, 2.0)); };
  double factor = 0, bytes = problem::dense_bytes(near);
  const bool glued = problem.rows() > 0 && linear;  // else each body has a factor of its own
  if (glued) factor = factor_of(n), bytes = bytes_of(n);
  else for (const problem::Block& block : problem.blocks) factor += factor_of(block.size()), bytes += bytes_of(block.size());
  const double rows = (space ? 81 : 24) * m * m * m, each = friction ? INFINITY : kSteps * factor_of(n);
  const double factors = (space ? 6e-6 : 1e-6) * n + std::min(factor + rows, each) / kFlops;
  return {{factors * (friction ? kFriction : 1), bytes},
          {kOpening + kMultigrid[space][quadratic][!geometric] * n * solves * several_bodies, (space ? 1000 : 500) * (geometric ? 1 : 1.8) * (quadratic ? 2.5 : 1) * n}};
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

/// Without rows: one linear solve. With rows: begins on those that overlap at rest, where that applies; otherwise calls run().
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
  const bool by_multigrid = by_default == DefaultMethod::multigrid && (!from.condenser || takes_multigrid(problem, *from.condenser));
  if (!condensed && (by_multigrid || (by_default == DefaultMethod::held && !from.condenser))) {
    before = run_held(problem, by_multigrid, from, monitor);
    if (before.converged || monitor.stop()) return before;
  }
  const std::string tried = before.reason.empty() ? "" : "; before, on all unknowns: " + before.reason;
  try {
    Result result = run_otherwise(problem, by_default, std::move(from), monitor, condensed);
    result.reason += tried;
    if (!tried.empty()) result.clock.add_solve(before.clock);
    return result;
  } catch (const InputError& error) {
    if (tried.empty()) throw;
    throw InputError(error.what() + tried);
  }
}

}  // namespace dotyk::solver
