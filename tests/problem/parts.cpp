#include "problem/parts.hpp"

#include <doctest/doctest.h>

#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// A body of one unknown on a spring k, loaded by f.
problem::Block spring(double k, double f) {
  problem::Block block;
  block.K = algebra::SparseMatrix(DenseMatrix::Constant(1, 1, k).sparseView());
  block.f = Vector::Constant(1, f);
  block.kernel.resize(1, 0);
  block.node = {0};
  return block;
}

/// Springs; the first touches the third, the second a wall: u₁ − u₃ ≤ 0, u₂ ≤ 0.
problem::Problem springs(double small) {
  problem::Problem p;
  for (const double f : {1.0, small, -1.0}) problem::add(p, spring(std::abs(f), f));
  p.B = DenseMatrix{{1, 0, -1}, {0, 1, 0}}.sparseView();
  p.c = Vector::Zero(2);
  p.groups = {{"touch", problem::unilateral(), 0, 1}, {"wall", problem::unilateral(), 1, 1}};
  return p;
}

}  // namespace

TEST_CASE("blocks that rows join are one part") {
  const problem::Parts parts = problem::parts(springs(1));
  CHECK(parts.count == 2);
  CHECK(parts.of_block == std::vector<int>{0, 1, 0});
  CHECK(parts.of_row == std::vector<int>{0, 1});
  CHECK(parts.greatest(Vector{{-3, 2}}) == std::vector<double>{3, 2});
}

TEST_CASE("what is wrong in one part is not small beside another") {
  for (const double small : {1.0, 1e-8, 1e-14}) {
    const problem::Problem p = springs(small);
    const problem::State right{Vector::Zero(3), Vector{{1, small}}};
    CHECK(problem::residual(p, right).law == 0);
    CHECK(problem::residual(p, right).equilibrium == 0);
    // The wall bears nothing, and is entered; or its body is not in equilibrium.
    CHECK(problem::residual(p, {Vector{{0, 1, 0}}, Vector{{1, 0}}}).law > 0.1);
    CHECK(problem::residual(p, {Vector{{0, 1, 0}}, Vector{{1, 0}}}).penetration > 0.1);
    CHECK(problem::residual(p, {Vector::Zero(3), Vector{{1, 0}}}).equilibrium > 0.1);
    CHECK(problem::residual(p, {Vector::Zero(3), Vector{{1, -small}}}).law > 0.1);  // tension
  }
}
