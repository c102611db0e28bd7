#include "solver/refine.hpp"

#include <algorithm>

#include "algebra/lu.hpp"
#include "problem/residual.hpp"
#include "solver/natural_map.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;
using problem::State;

namespace {

Vector out_of_balance(const Problem& problem, const State& state) {
  Vector left = -(problem.B.transpose() * state.lambda);
  for (const problem::Block& block : problem.blocks) {
    const auto u = state.u.segment(block.first, block.size());
    left.segment(block.first, block.size()) += block.f - block.K.selfadjointView<Eigen::Lower>() * u;
  }
  return left;
}

/// Newton's step from this state; nothing where the derivative is singular.
std::optional<State> step(const Problem& problem, const CondensedProblem& condensed, const State& from) {
  const Vector balanced = from.u + condensed.response(out_of_balance(problem, from), Vector::Zero(condensed.kernel_size()));
  const Vector x = problem.B * balanced - problem.c;
  const CondensedProblem missing = condensed.missing(from.lambda, x);
  const NaturalMap map(problem, missing, stiffness_of_rows(condensed));
  // λ + λ' = P + S (λ + λ' + ρ(x − Wλ' + Nα') − y), y = λ + ρx, an equation of λ' that the missing problem's own x = x − … turns into the map's.
  NaturalMap::Value value = map.with_jump(from.lambda, x);
  value.projected -= from.lambda;
  value.y = map.rho().cwiseProduct(x);
  const NaturalMap::System system = map.linearise(value);
  Vector solved(0), lambda, alpha;
  if (system.matrix.size() > 0) solved = algebra::Lu(system.matrix).solve(system.right_side);
  if (!solved.allFinite()) return std::nullopt;
  map.take(system, solved, lambda, alpha);
  State to{balanced + condensed.response(-(problem.B.transpose() * lambda), alpha), from.lambda + lambda};
  return to.u.allFinite() && to.lambda.allFinite() ? std::optional(std::move(to)) : std::nullopt;
}

}  // namespace

double off_laws(const Problem& problem, const State& state) {
  const problem::Residual r = problem::residual(problem, state);
  return std::max({r.penetration, r.complementarity, r.law});
}

bool refine(const Problem& problem, const CondensedProblem& condensed, State& state) {
  constexpr int kSteps = 3;
  const auto off = [&](const State& s) {
    const problem::Residual r = problem::residual(problem, s);
    return std::max({r.penetration, r.complementarity, r.law, r.equilibrium});
  };
  double before = off(state);
  bool better = false;
  for (int k = 0; k < kSteps; ++k) {
    std::optional<State> next = step(problem, condensed, state);
    if (!next) break;
    const double left = off(*next);
    if (!(left < before)) break;
    state = std::move(*next), better = true;
    if (left > 0.1 * before) break;
    before = left;
  }
  return better;
}

}  // namespace dotyk::solver
