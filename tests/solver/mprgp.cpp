// Mprgp on random dense programs whose solution is known, with what theory promises asserted at every step.
#include "solver/bounded/mprgp.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/known_minimum.hpp"
#include "program/active_set.hpp"
#include "program/interior_point.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::Mprgp;
using solver::MprgpSettings;
using solver::SeparableSet;
using test::below;
using test::KnownMinimum;
using test::kShapes;
using test::map;
using test::Random;
using test::Shape;

namespace {

using Expansion = MprgpSettings::Expansion;
using Halt = Mprgp::Halt;
using Step = Mprgp::Step;

constexpr Expansion kExpansions[] = {Expansion::fixed_step, Expansion::projected_cg_step};
struct Counts {
  int steps = 0, faces = 0;
};

/// Steps to ‖g^P‖ ≤ tol, each one asserted to keep x in Ω, to lower q (up to 1e-14 of the greatest |q| met,
/// what rounding of the sum leaves) and to be of the kind that proportionality asks for.
Counts follow(Mprgp& method, const SeparableSet& set, double tol, int limit) {
  Counts counts;
  double scale = std::abs(method.q());
  while (method.projected_gradient_norm() > tol && counts.steps < limit) {
    const bool proportional = method.proportional();
    const double q = method.q();
    const auto face = method.face();
    const int products = method.products();
    const Step step = method.step();
    REQUIRE(step != Step::none);
    ++counts.steps;
    if (face != method.face()) ++counts.faces;
    scale = std::max(scale, std::abs(method.q()));
    REQUIRE(method.q() <= q + 1e-14 * scale);
    REQUIRE(set.contains(method.x()));
    REQUIRE((step == Step::proportioning) == !proportional);
    if (!set.has_discs()) {  // one more where g is computed anew; up to four projected steps
      const int most = step == Step::expansion ? 7 : step == Step::projection ? 5 : 1;
      REQUIRE(method.products() - products <= most + 1);
    }
  }
  CHECK(counts.steps < limit);
  return counts;
}

program::SparseMatrix sparse(const DenseMatrix& A) { return A.sparseView(); }

}  // namespace

TEST_CASE("known minima of every shape are found, each step as theory has it") {
  for (const Shape shape : kShapes)
    for (const double least : {0.1, 1e-2, 1e-4})
      for (const Expansion expansion : kExpansions) {
        CAPTURE(int(shape));
        CAPTURE(least);
        CAPTURE(int(expansion));
        Random random(7);
        const int n = 120;
        const DenseMatrix A = test::random_matrix(random, n, least);
        const KnownMinimum known = test::known_minimum(random, n, shape);
        const Vector b = A * known.x - known.g;
        Mprgp method(map(A), 1, b, known.set, Vector::Zero(n), {.expansion = expansion});
        follow(method, known.set, 1e-10 * b.norm(), 2000);
        method.refresh();
        // ‖x − x*‖ ≤ ‖g^P‖/λ_min; and gᵀ(x − y) ≤ ‖g^P‖ ‖x − y‖ for every y of Ω, so for the solution.
        CHECK((method.x() - known.x).norm() <= 1.5e-10 * b.norm() / least);
        CHECK((A * method.x() - b - method.g()).norm() <= 1e-13 * b.norm());
      }
}

TEST_CASE("products with A grow no faster than the square root of the condition number") {
  // Conjugate gradients on all of Rⁿ reduce the energy's error by ε in ½√κ ln(2/ε) steps; ‖g‖ ≤ 1e-8 ‖b‖ is had
  // with ε = 1e-8/√κ. On faces A is better conditioned;
  // along circles, curvature adds to A and a step may take two products.
  for (const Shape shape : kShapes)
    for (const double kappa : {1e1, 1e2, 1e3, 1e4}) {
      CAPTURE(int(shape));
      CAPTURE(kappa);
      Random random(11);
      const int n = 200;
      const DenseMatrix A = test::random_matrix(random, n, 1 / kappa);
      const KnownMinimum known = test::known_minimum(random, n, shape);
      const Vector b = A * known.x - known.g;
      Mprgp method(map(A), 1, b, known.set, Vector::Zero(n));
      test::minimise(method, below(1e-8 * b.norm()));
      CHECK(method.halt() == Halt::none);
      const double theory = 0.5 * std::sqrt(kappa) * std::log(2e8 * std::sqrt(kappa));
      CHECK(method.products() <= (shape == Shape::discs || shape == Shape::mixed ? 1.3 : 1.02) * theory + 10);
    }
}

TEST_CASE("box-constrained programs: the same minimum as by the active-set and the interior-point method") {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    Random random(seed);
    const int n = 60;
    const DenseMatrix A = test::random_matrix(random, n, 1e-3);
    const Vector low = 0.4 * random.vector(n), b = 0.3 * random.vector(n);
    const Vector high = low + Vector(random.vector(n).cwiseAbs());
    const SeparableSet set(low, high);
    Mprgp method(map(A), 1, b, set, low);
    test::minimise(method, below(1e-12 * b.norm()));
    CHECK(method.halt() == Halt::none);

    program::QuadraticProgram qp;
    qp.P = sparse(A.triangularView<Eigen::Lower>());
    qp.q = -b;
    qp.A = program::SparseRows(sparse(DenseMatrix::Identity(n, n)));
    qp.low = low;
    qp.high = high;
    Monitor quiet;
    const auto exact = program::solve(qp, program::ActiveSet{}, quiet);
    const auto interior = program::solve(qp, program::InteriorPoint{}, quiet);
    REQUIRE(exact.status == program::Status::solved);
    REQUIRE(interior.status == program::Status::solved);
    CHECK((method.x() - exact.x).norm() <= 1e-9);  // 1e-12 ‖b‖ κ, ‖b‖ ≈ 1
    CHECK((method.x() - interior.x).norm() <= 1e-5);  // its tolerance 1e-9 times κ
    CHECK(method.q() == doctest::Approx(exact.objective).epsilon(1e-12));
  }
}

TEST_CASE("dual degenerate programs: no oscillation, the faces change but a few times") {
  // All active components have g = 0: two thirds of x hang between free and active.
  for (const Shape shape : {Shape::low, Shape::box, Shape::discs, Shape::mixed})
    for (const Expansion expansion : kExpansions)
      for (const unsigned seed : {1u, 2u, 3u}) {
        CAPTURE(int(shape));
        CAPTURE(int(expansion));
        Random random(seed);
        const int n = 150;
        const DenseMatrix A = test::random_matrix(random, n, 1e-2);
        const KnownMinimum known = test::known_minimum(random, n, shape, 1);
        const Vector b = A * known.x - known.g;
        Mprgp method(map(A), 1, b, known.set, Vector::Zero(n), {.expansion = expansion});
        const Counts counts = follow(method, known.set, 1e-10 * b.norm(), 1000);
        CHECK((method.x() - known.x).norm() <= 1.5e-10 * b.norm() / 1e-2);
        CHECK(counts.steps <= 150);
        CHECK(counts.faces <= n);
      }
}
