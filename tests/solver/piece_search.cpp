#include "solver/pieces/piece_search.hpp"

#include <doctest/doctest.h>

#include <optional>

#include "../support/friction.hpp"
#include "base/error.hpp"
#include "problem/residual.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/pieces/enumeration.hpp"
#include "solver/core/friction_bound.hpp"
#include "solver/rows/newton.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using Verdict = solver::PieceSearch::Verdict;

namespace {

/// Nodes with Coulomb friction on a body that one motion r leaves as it is: K r = 0.
problem::Problem free_body(test::Random& random, int nodes, int d, double mu) {
  auto p = test::friction_program(random, nodes, d, problem::coulomb(std::vector<double>(nodes, mu)));
  problem::Block& body = p.blocks[0];
  const Vector r = random.vector(body.size()).normalized();
  DenseMatrix K = DenseMatrix(body.K.lower()).selfadjointView<Eigen::Lower>();
  const DenseMatrix P = DenseMatrix::Identity(r.size(), r.size()) - r * r.transpose();
  K = P * K * P;
  body.K = algebra::SparseMatrix(DenseMatrix(K.triangularView<Eigen::Lower>()).sparseView());
  body.kernel = r / r.lpNorm<Eigen::Infinity>();
  return p;
}

problem::CondensedProblem condensed(const problem::Problem& p) {
  Monitor quiet;
  problem::Clock clock;
  return {p, problem::rigid_motions(p), algebra::Ordering::automatic, clock, quiet};
}

/// By all combinations of pieces; nothing where the body is not held at all.
std::optional<bool> has_solution(const problem::Problem& p) {
  Monitor quiet;
  try {
    const auto all = solver::enumerate(p, quiet);
    return !all.solutions.empty() || !all.families.empty();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The points of programmes are all that is tried.
const solver::Attempt no_attempt = [](Vector&, Vector&) { return false; };

}  // namespace

TEST_CASE("free bodies with friction in the plane: the search excludes all pieces just where all combinations were tried in vain") {
  Monitor quiet;
  int solvable = 0, unsolvable = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    const auto p = free_body(random, 3, 1, 0.1 + 0.01 * seed);
    const std::optional<bool> exists = has_solution(p);
    if (!exists) continue;
    const problem::CondensedProblem rows = condensed(p);
    const auto found = solver::search_pieces(p, rows, no_attempt, quiet);
    REQUIRE(found.verdict == (*exists ? Verdict::near : Verdict::none));
    ++(*exists ? solvable : unsolvable);
    if (!*exists) continue;
    // A point without a broken pair solves the problem up to the accuracy of programmes.
    const Vector x = rows.jump(found.lambda, found.alpha);
    CHECK(problem::distances_from_laws(p, x, found.lambda, Vector::Ones(x.size())).norm() < 1e-6 * (1 + found.lambda.norm() + x.norm()));
    CHECK((rows.N().transpose() * found.lambda - rows.e()).norm() < 1e-7 * (1 + rows.e().norm()));
  }
  CHECK(solvable > 20);
  CHECK(unsolvable > 5);
}

TEST_CASE("free bodies with friction in space: what the search excludes, no method solves; what a method solves, the search does not exclude" * doctest::test_suite("large")) {
  Monitor quiet;
  int solved = 0, excluded = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    const auto p = free_body(random, 3, 2, 0.1 + 0.02 * seed);
    const problem::CondensedProblem rows = condensed(p);
    solver::Newton method;
    bool converges = false;
    for (unsigned start = 1; start <= 5 && !converges; ++start) {
      method.seed = start;
      solver::RowIteration iteration(p, rows, method, method.map_weight(), quiet);
      try {
        method.iterate(iteration);
        converges = iteration.converged();
      } catch (const InputError&) {  // its own search excludes all
      }
    }
    const auto found = solver::search_pieces(p, rows, no_attempt, quiet);
    CHECK_FALSE((converges && found.verdict == Verdict::none));
    solved += converges;
    excluded += found.verdict == Verdict::none;
  }
  CHECK(solved > 10);
  CHECK(excluded > 5);
}

TEST_CASE("free bodies with friction in the plane: what the energy bound excludes has no solution") {
  Monitor quiet;
  int proved = 0, unsolvable = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    const auto p = free_body(random, 3, 1, 0.1 + 0.002 * seed);
    const auto motion = solver::stopped_by_friction_alone(p);
    if (!motion) continue;
    const bool excluded = solver::friction_is_too_weak(p, condensed(p), *motion, quiet);
    proved += excluded;
    const std::optional<bool> exists = has_solution(p);
    if (!exists) continue;
    CHECK_FALSE((*exists && excluded));
    unsolvable += !*exists;
  }
  CHECK(unsolvable > 40);
  CHECK(proved > 0.8 * unsolvable);
}
