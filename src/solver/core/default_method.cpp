#include "solver/core/default_method.hpp"

#include "base/memory.hpp"
#include "multigrid/multigrid.hpp"
#include "problem/coarser.hpp"
#include "solver/active/pdas.hpp"
#include "solver/core/near_rows.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/turned_nodes.hpp"
#include "solver/rows/newton.hpp"

namespace dotyk::solver {

using By = Choice::By;

namespace {

/// Below so many unknowns nothing takes long enough to be worth an estimate.
constexpr int kLarge = 8000;
/// Bodies with fewer unknowns on average are too small to coarsen.
constexpr int kLeastBody = 500;
/// Multigrid is chosen where factors are estimated to take kFaster times as long, since its number of iterations is less
/// certain. In a history, where one factor serves all steps, they must take kFactorIsKept times as long.
constexpr double kFaster = 1.4, kFactorIsKept = 10;
constexpr double kOpening = 0.2;  ///< seconds that the library of multigrid takes to open
constexpr double kBeside = 1.25;  ///< other arrays take a quarter of what factors take

/// Steps of active sets, of which each takes a factor where rows are held on all unknowns.
constexpr double kHeldSteps = 8;

/// Operations of a factor, measured by scripts/studies/crossing.lua.
double flops_of_factor(double unknowns, bool space, bool quadratic) {
  return space ? (quadratic ? 10 : 7.5) * unknowns * unknowns : (quadratic ? 130 : 80) * std::pow(unknowns, 1.5);
}

struct Cost {
  double seconds, bytes;
};
struct Estimate {
  Cost factors, multigrid;
  double largest;  ///< bytes of the largest factor
};

/// Of solid bodies with so many rows, `near` of which are condensed. Bytes of factors are within a sixth of what orderings predict.
Estimate estimate(const problem::Problem& problem, double rows_in_all, double near) {
  // Constants measured by scripts/studies/crossing.lua. n: unknowns; m: contact points with d components each. A factor takes 7.5 n² operations in space (order 2:
  // 10 n²) and 80 n^1.5 in the plane (order 2: 130 n^1.5). Frictionless contact adds 3 (dm)³ for dense matrices, or takes a factor a step. Ordering grows with n.
  constexpr double kFlops = 1.25e10, kFriction = 1.5;
  constexpr double kMultigrid[2][2][2] = {{{2.2e-6, 7e-6}, {4.8e-6, 9.6e-6}}, {{4e-6, 1.6e-5}, {4.8e-5, 4.8e-5}}};  // seconds an unknown: plane, space; order 1, 2; meshes, aggregates
  const bool space = problem.blocks.front().coarse.dimension == 3;
  const bool geometric = problem::coarser_meshes(problem) > 1, linear = all_linear(problem), friction = !problem.friction.empty();
  const bool quadratic = std::any_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.coarse.order == 2; });
  double tangential = 0;
  for (const problem::FrictionGroup& group : problem.friction) tangential += group.components * group.points();
  const double n = problem.unknowns(), m = near * (1 - tangential / std::max(rows_in_all, 1.0)) * !linear;
  const double solves = linear ? 0.6 : friction ? 1.6 : 1;               // times as many iterations
  const double several_bodies = problem.blocks.size() > 1 ? 2 : 1;       // times the work of one
  const auto factor_of = [&](double size) { return flops_of_factor(size, space, quadratic); };
  const auto bytes_of = [&](double size) { return space ? 200 * std::pow(size, 4.0 / 3) : 60 * size * std::log2(std::max(size, 2.0)); };
  double factor = 0, bytes = problem::dense_bytes(near), largest = 0;
  const auto add = [&](double size) { factor += factor_of(size), bytes += bytes_of(size), largest = std::max(largest, bytes_of(size)); };
  const bool glued = problem.rows() > 0 && linear;  // else each body has a factor of its own
  if (glued) add(n);
  else for (const problem::Block& block : problem.blocks) add(block.size());
  const double rows = (space ? 81 : 24) * m * m * m, each = kHeldSteps * factor_of(n);
  const double factors = (space ? 6e-6 : 1e-6) * n + std::min(factor + rows, each) / kFlops;
  return {{factors * (friction ? kFriction : 1), bytes},
          {kOpening + kMultigrid[space][quadratic][!geometric] * n * solves * several_bodies, (space ? 1000 : 500) * (geometric ? 1 : 1.8) * (quadratic ? 2.5 : 1) * n},
          largest};
}

std::string words(const Cost& of) {
  return text(std::ceil(10 * of.seconds) / 10, " s on a core and ", std::ceil(of.bytes * 1e-6), " MB");
}

/// Takes multigrid where it fits with its library and is the better choice. `rows`: those that factors are left with.
void weigh(const problem::Problem& problem, const RowSubset& rows, double memory, const problem::Condenser* kept, Choice& choice) {
  constexpr double kUsual[] = {45, 25}, kShare = 0.4;  // iterations, without and with coarser meshes; of the seconds
  double near = 0;
  for (int r = 0; r < problem.rows(); ++r) near += rows.kept()[r] && (choice.near.empty() || choice.near[r]);
  const Estimate e = estimate(problem, rows.count(), near);
  const bool countable = e.largest <= algebra::Cholesky::kMostBytes;
  const bool fit = (kept && kept->holds()) || kBeside * e.factors.bytes <= memory;
  const bool possible = multigrid::available() && tells_springs(problem) && problem.unknowns() >= kLeastBody * std::ssize(problem.blocks) &&
                        multigrid::bytes_to_open() + e.multigrid.bytes <= memory;
  const bool faster = e.factors.seconds > (kept ? kFactorIsKept : kFaster) * e.multigrid.seconds;
  choice.factors_fit = countable && fit;
  if (choice.factors_fit)
    choice.most_iterations = kUsual[problem::coarser_meshes(problem) > 1] *
                             (1 + std::max(0.0, e.factors.seconds / (e.multigrid.seconds - kOpening) - 1) / kShare);
  const std::string factors = text("factors would take some ", words(e.factors), countable ? "" : ", more than CHOLMOD's indices reach",
                                   fit ? "" : text(", more than fits into the ", std::floor(memory * 1e-6), " MB of memory"));
  if (possible && (faster || (!choice.factors_fit && e.multigrid.bytes < e.factors.bytes)))
    choice.by = By::multigrid, choice.costs = text(": some ", words(e.multigrid), ", where ", factors);
  else
    choice.costs = (choice.factors_fit ? "" : "; " + factors) + (possible ? "; multigrid would take some " + words(e.multigrid) : "");
}

/// Has nearly every row an unknown that no other row has, as those of mortar glue of order 1 do? Else the basis of rows fills up.
bool rows_stand_apart(const problem::Problem& problem) {
  constexpr double kNearly = 0.9;
  std::vector<int> rows_with(problem.unknowns(), 0), own(problem.rows(), 0);
  const auto for_each = [&](auto&& work) {
    for (int r = 0; r < problem.rows(); ++r)
      for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it)
        if (it.value() != 0) work(r, rows_with[it.col()]);
  };
  for_each([](int, int& count) { ++count; });
  for_each([&](int r, int count) { own[r] |= count == 1; });
  return std::count(own.begin(), own.end(), 1) >= kNearly * problem.rows();
}

/// Is it less work to hold rows on all unknowns than to condense them to dense matrices?
bool better_held(const problem::Problem& problem) {
  constexpr int kFew = 150;
  if (problem.rows() < kFew || !tells_springs(problem)) return false;
  if (all_linear(problem)) return rows_stand_apart(problem);
  const problem::CoarseMeshes& mesh = problem.blocks.front().coarse;
  return kHeldSteps * flops_of_factor(problem.unknowns(), mesh.dimension != 2, mesh.order == 2) < 3 * std::pow(problem.rows(), 3);
}

By on_condensed_rows(const problem::Problem& problem) {
  return problem.rows() == 0 ? By::linear : problem.friction.empty() && tells_springs(problem) ? By::pdas : By::newton;
}

}  // namespace

Choice by_factors(const problem::Problem& problem, const problem::Condenser* kept) {
  Choice choice{on_condensed_rows(problem)};
  if (better_held(problem) && !(kept && all_linear(problem))) choice.by = By::held;
  if (!kept) choice.near = rows_that_may_close(problem);
  return choice;
}

Choice choose(const problem::Problem& problem, double memory, const problem::Condenser* kept) {
  Choice choice = by_factors(problem, kept);
  const RowSubset rows = kept ? RowSubset(problem) : TurnedNodes(problem);
  const auto solid = [](const problem::Block& block) { return block.rigid && block.coarse.dimension > 0; };
  if (problem.unknowns() >= kLarge && problem.subdomains.empty() && std::ranges::all_of(problem.blocks, solid))
    weigh(problem, rows, memory, kept, choice);
  choice.turned = choice.by != By::multigrid && !rows.all();
  return choice;
}

namespace {

/// On these rows, or all unknowns.
Result run(const problem::Problem& problem, By by, Beginning from, Monitor& monitor, double most_iterations = INFINITY) {
  if (by == By::linear) return solve_linear(problem, {}, monitor);
  if (by == By::newton) return Method(Newton{}).run(problem, std::move(from), monitor);
  Pdas pdas = by == By::multigrid ? Multigrid() : Pdas();
  if (by == By::multigrid) pdas.linear = multigrid(Levels::meshes, most_iterations);
  pdas.reduced = by == By::pdas, pdas.interior = by == By::interior;
  return Method(pdas).run(problem, std::move(from), monitor);
}

/// On the rows that may close; nothing where they do not hold the bodies, or come to no end.
std::optional<Result> run_near(NearRows near, By by, Beginning from, Monitor& monitor) {
  problem::Clock before;
  const auto condenser = std::make_shared<problem::Condenser>();
  for (;;) try {
      Beginning beginning = near.restricted(from);
      beginning.condenser = condenser;
      Result result = run(near.restricted(), by, std::move(beginning), monitor);
      near.extend(result);
      result.clock.add_solve(before);
      if (!result.converged && !monitor.stop()) return std::nullopt;
      const std::vector<char> kept = near.kept();
      if (!result.converged || !near.join(result.state.u)) return result;
      condenser->grow(near.places(kept));
      before = result.clock;
      from = {result.active_sets.back(), nullptr, nullptr};
    } catch (const NotHeld&) {
      return std::nullopt;
    }
}

/// With rows that turned nodes make unnecessary left out; nothing where that does not solve it.
std::optional<Result> run_turned(const problem::Problem& problem, const Beginning& from, Monitor& monitor) {
  Stopwatch watch;
  const TurnedNodes nodes(problem);
  try {
    const problem::Problem turned = nodes.turned();
    const double before = watch.lap();
    Result result = solve_chosen(turned, by_factors(turned), nodes.turned(from), monitor);
    watch.lap();
    nodes.extend(result);
    result.clock.assembly += before, result.clock.recover += watch.lap();
    if (result.converged || monitor.stop()) return result;
  } catch (const NotHeld&) {  // said anew of the problem as it was given, whose motions have names
  }
  return std::nullopt;
}

/// On the rows of the choice first, where they are not all.
Result run_condensed(const problem::Problem& problem, By by, const Choice& choice, Beginning from, Monitor& monitor) {
  if (!choice.near.empty()) {
    NearRows near(problem, choice.near, from.start);
    if (auto result = near.all() ? std::nullopt : run_near(std::move(near), by, from, monitor)) return *std::move(result);
  }
  return run(problem, by, std::move(from), monitor);
}

}  // namespace

Result solve_chosen(const problem::Problem& problem, const Choice& choice, Beginning from, Monitor& monitor) {
  if (choice.turned)
    if (auto result = run_turned(problem, from, monitor)) return *std::move(result);
  if (choice.by != By::held && choice.by != By::multigrid) return run_condensed(problem, choice.by, choice, std::move(from), monitor);
  Result before;
  const Stopwatch watch;
  try {
    before = run(problem, choice.by, {from.start, nullptr, from.from}, monitor, choice.most_iterations);
    if (before.converged || !choice.factors_fit || monitor.stop()) return before;
  } catch (const NotSolved& error) {
    if (!choice.factors_fit) throw;
    before.reason = error.what(), before.clock.iterate = watch.seconds();
  }
  const std::string tried = "; before, on all unknowns: " + before.reason;
  try {
    Result result = run_condensed(problem, on_condensed_rows(problem), choice, std::move(from), monitor);
    result.reason += tried;
    result.clock.add_solve(before.clock);
    return result;
  } catch (const InputError& error) {
    throw InputError(error.what() + tried);
  }
}

Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor, std::optional<bool> condensed) {
  if (method) {
    const bool linear = problem.rows() == 0 && !method.takes_linear() && !method.decomposition();
    return linear ? solve_linear(problem, method.ordering(), monitor) : method.run(problem, std::move(from), monitor);
  }
  Choice choice = condensed ? Choice{on_condensed_rows(problem)} : choose(problem, memory_limit(), from.condenser.get());
  if (condensed == false && choice.by == By::pdas) choice.by = By::interior;
  return solve_chosen(problem, choice, std::move(from), monitor);
}

}  // namespace dotyk::solver
