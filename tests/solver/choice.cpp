#include <doctest/doctest.h>

#include <cmath>
#include <new>

#include "../support/programs.hpp"
#include "multigrid/multigrid.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/require_solvable.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using By = solver::Choice::By;

namespace {

/// A solid in space of so many unknowns, which has sizes alone: no stiffness, no mesh.
problem::Problem solid(int unknowns) {
  problem::Problem p;
  problem::Block& block = p.blocks.emplace_back();
  block.f = Vector::Zero(unknowns);
  block.kernel.resize(unknowns, 0);
  block.rigid = [unknowns]() -> DenseMatrix { FAIL("a choice needs no rigid motions"); return DenseMatrix(unknowns, 6); };
  block.coarse.dimension = 3;
  p.B.resize(0, unknowns);
  return p;
}

/// Throws once where the first phase is told.
struct OutOfMemoryOnce : Monitor {
  void phase(const std::string&) override {
    if (!std::exchange(thrown, true)) throw std::bad_alloc();
  }
  bool thrown = false;
};

}  // namespace

TEST_CASE("large solids: multigrid where it fits into the memory that is stated and factors do not, or have more numbers than can be counted") {
  if (!multigrid::available()) return;
  const problem::Problem p = solid(20'000);
  const solver::Choice fits = solver::choose(p, INFINITY), tight = solver::choose(p, 1e8);
  CHECK(fits.by == By::linear);
  CHECK(fits.factors_fit);
  CHECK(tight.by == (multigrid::bytes_to_open() > 0 ? By::linear : By::multigrid));  // the library would not fit, either
  CHECK_FALSE(tight.factors_fit);
  CHECK(std::isinf(tight.most_iterations));
  CHECK_MESSAGE(tight.costs.find("than fits into the 100 MB") != std::string::npos, tight.costs);

  CHECK(solver::choose(solid(600'000), INFINITY).factors_fit);
  const solver::Choice uncountable = solver::choose(solid(1'200'000), INFINITY);
  CHECK(uncountable.by == By::multigrid);
  CHECK_FALSE(uncountable.factors_fit);
  CHECK_MESSAGE(uncountable.costs.find("CHOLMOD") != std::string::npos, uncountable.costs);
}

TEST_CASE("a history's factor serves all its steps: multigrid must be faster by far") {
  if (!multigrid::available()) return;
  const problem::Problem p = solid(60'000);
  const problem::Condenser kept;
  CHECK(solver::choose(p, INFINITY).by == By::multigrid);
  CHECK(solver::choose(p, INFINITY, &kept).by == By::linear);
}

TEST_CASE("what the method chosen first refuses is not tried by another one, and want of memory is not either") {
  const solver::Choice held{By::held}, condensed{By::pdas};
  Monitor quiet;
  // Two unknowns that a spring joins, pulled along the motion that nothing stops; a row that they do not press.
  problem::Problem p = test::program(DenseMatrix{{1, -1}, {-1, 1}}, Vector::Constant(2, -1), DenseMatrix{{1, 0}}, Vector::Ones(1));
  p.blocks[0].kernel = DenseMatrix::Ones(2, 1);
  p.blocks[0].motions = {{Motion::Kind::translation, {1}}};
  std::string once;
  try {
    solver::solve_chosen(p, condensed, {}, quiet);
  } catch (const solver::NotHeld& error) {
    once = error.what();
  }
  REQUIRE(once.find("not held") == 0);
  CHECK_THROWS_WITH_AS(solver::solve_chosen(p, held, {}, quiet), once.c_str(), solver::NotHeld);

  OutOfMemoryOnce monitor;
  p.blocks[0].f = Vector::Ones(2);
  CHECK(solver::solve_chosen(p, held, {}, quiet).converged);
  CHECK_THROWS_AS(solver::solve_chosen(p, held, {}, monitor), std::bad_alloc);
}
