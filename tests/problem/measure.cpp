#include "problem/measure.hpp"

#include <doctest/doctest.h>

#include "problem/condensed.hpp"
#include "problem/free_motions.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

problem::Block spring_between(double k, double f) {
  problem::Block block;
  block.K = algebra::SparseMatrix(DenseMatrix::Constant(1, 1, k).sparseView());
  block.f = Vector::Constant(1, f);
  block.kernel.resize(1, 0);
  block.node = {0};
  return block;
}

/// Bodies on springs; rows B u ≤ c.
problem::Problem bodies(const std::vector<std::pair<double, double>>& stiffness_and_load, const DenseMatrix& B, const Vector& c) {
  problem::Problem p;
  for (const auto& [k, f] : stiffness_and_load) problem::add(p, spring_between(k, f));
  p.B = B.sparseView();
  p.c = c;
  p.groups = {{"contact", problem::unilateral(), 0, static_cast<int>(c.size())}};
  return p;
}

}  // namespace

TEST_CASE("what is nothing on a row is its part's own, and in proportion to force and length") {
  const DenseMatrix B = DenseMatrix::Identity(2, 2);
  for (const double force : {1e-12, 1.0, 1e12})
    for (const double length : {1e-3, 1.0, 1e3}) {
      const double k = force / length;
      const problem::Measure m(bodies({{2 * k, force}, {3 * k, 1e-9 * force}}, B, Vector{{0.5 * length, 0}}));
      const problem::Nothing none = m.nothing(0.1, Vector{{force, 1e-9 * force}}, Vector{{-0.25 * length, 1e-9 * length}});
      CHECK(none.force[0] == doctest::Approx(0.1 * (1 + 2 * 0.5) * force));
      CHECK(none.force[1] == doctest::Approx(0.1 * (1 + 3) * 1e-9 * force));
      CHECK(none.gap[0] == doctest::Approx(none.force[0] / (2 * k)));
    }
}

TEST_CASE("a gap that says never is no measure of what is nothing, on its own row or on others") {
  const problem::Measure m(bodies({{2, 1}}, DenseMatrix::Ones(2, 1), Vector{{0.5, 1e30}}));
  const problem::Nothing none = m.nothing(0.1, Vector{{1, 0}}, Vector{{0, -1e30}});
  for (const int r : {0, 1}) CHECK(none.force[r] == doctest::Approx(0.1 * (1 + 2 * 0.5)));
}

TEST_CASE("a row that no unknown moves is as stiff as the stiffest; where none moves any the stiffness is 1") {
  const problem::Problem some = bodies({{2, 1}, {5, 1}}, DenseMatrix{{1, 0}, {0, 1}, {0, 0}}, Vector::Zero(3));
  CHECK(problem::Measure(some).stiffness() == Vector{{2, 5, 5}});
  CHECK(problem::Measure(some, problem::CondensedProblem(DenseMatrix(Vector{{0.5, 0.25, 1e-20}}.asDiagonal()), Vector::Zero(3))).stiffness() == Vector{{2, 4, 4}});
  const problem::Problem none = bodies({{2, 1}}, DenseMatrix::Zero(2, 1), Vector::Zero(2));
  CHECK(problem::Measure(none).stiffness() == Vector::Ones(2));
}

TEST_CASE("F of what rows bear: the load, and forces at rest only as far as they are borne") {
  const problem::Measure m(bodies({{2, 3}}, DenseMatrix::Ones(1, 1), Vector::Constant(1, -10)));  // an overlap of 10 on a spring of 2
  CHECK(m.force(0) == doctest::Approx(20));
  CHECK(m.force(0, 7) == doctest::Approx(7));
  CHECK(m.force(0, 1) == doctest::Approx(3));
  CHECK(m.force(0, 100) == doctest::Approx(20));
}

TEST_CASE("the greatest forces of one body do not say what is none on another") {
  // A heavy and a light body, both on a third.
  for (const double light : {1.0, 1e-9}) {
    const problem::Problem p = bodies({{1, 1}, {1, light}, {1, 0}}, DenseMatrix{{1, 0, -1}, {0, 1, -1}}, Vector::Zero(2));
    const problem::State state{Vector::Zero(3), Vector{{1, light}}};
    const problem::Measure m(p, state);
    const problem::NoForce none(p, m, state.lambda, 1e-8);
    CHECK(!none(0, 1, 0));
    CHECK(!none(1, light, 0));
    CHECK(none(1, 1e-8 * light, 0));
    CHECK(none(0, 5e-8, 1));   // what a method leaves on a row that is open
    CHECK(!none(0, 5e-8, 0));  // or not
  }
}
