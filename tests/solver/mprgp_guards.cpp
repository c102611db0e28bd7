// Mprgp where A is singular, wrong or preconditioned, and where rounding ends all.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/known_minimum.hpp"
#include "solver/bounded/mprgp.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::Mprgp;
using solver::SeparableSet;
using test::below;
using test::KnownMinimum;
using test::kShapes;
using test::map;
using test::Random;
using test::Shape;

namespace {

using Halt = Mprgp::Halt;

SeparableSet everything(int n) { return SeparableSet(Vector::Constant(n, -test::kNoEnd), Vector::Constant(n, test::kNoEnd)); }

}  // namespace

TEST_CASE("A with a kernel: a minimum is found, where bounds hold the kernel's part of b as where there is none") {
  for (const Shape shape : kShapes)
    for (const int kernel : {1, 20, 60}) {
      CAPTURE(int(shape));
      CAPTURE(kernel);
      Random random(4);
      const int n = 90;
      const DenseMatrix A = test::random_matrix(random, n, 1e-2, kernel);
      const KnownMinimum known = test::known_minimum(random, n, shape);
      const Vector b = A * known.x - known.g;  // a part of g is in the kernel
      Mprgp method(map(A), 1, b, known.set, Vector::Zero(n));
      test::minimise(method, below(1e-10 * b.norm()));
      CHECK(method.halt() == Halt::none);
      CHECK(method.steps() < 10000);
      CHECK(known.set.contains(method.x()));
      // q − q* ≤ ‖g^P‖ ‖x − x*‖, and A of the minimiser is unique.
      const double minimum = 0.5 * known.x.dot(known.g - b), distance = (method.x() - known.x).norm();
      CHECK(std::abs(method.q() - minimum) <= 1e-10 * b.norm() * distance + 1e-13 * std::abs(minimum));
      CHECK((A * (method.x() - known.x)).norm() <= 1e-4);
    }
}

TEST_CASE("zero curvature and nothing in the way: unbounded, along a direction that proves it") {
  Random random(5);
  const int n = 30;
  const DenseMatrix A = test::random_matrix(random, n, 0.1, 3);
  const Vector b = random.vector(n);  // not in the range of A
  const SeparableSet all = everything(n);
  Mprgp endless(map(A), 1, b, all, Vector::Zero(n));
  test::minimise(endless, below(0));
  REQUIRE(endless.halt() == Halt::unbounded);
  const Vector p = endless.direction() / endless.direction().norm();
  CHECK((A * p).norm() <= 1e-6);
  CHECK(p.dot(b) >= 1e-3);
}

TEST_CASE("rounding ends what asks for more than there is, soon and at its level") {
  for (const Shape shape : kShapes)
    for (const double least : {0.1, 1e-3}) {
      CAPTURE(int(shape));
      CAPTURE(least);
      Random random(6);
      const int n = 100;
      const DenseMatrix A = test::random_matrix(random, n, least);
      const KnownMinimum known = test::known_minimum(random, n, shape, 0.3);
      const Vector b = A * known.x - known.g;
      Mprgp to_twelve(map(A), 1, b, known.set, Vector::Zero(n)), to_end(map(A), 1, b, known.set, Vector::Zero(n));
      test::minimise(to_twelve, below(1e-12 * b.norm()));
      CHECK(to_twelve.halt() == Halt::none);
      test::minimise(to_end, below(0));
      CHECK((to_end.halt() == Halt::rounding || to_end.halt() == Halt::solved));
      CHECK(to_end.projected_gradient_norm() <= 1e-14 * b.norm());
      CHECK(to_end.products() <= 2 * to_twelve.products() + 20);
      CHECK(to_end.step() == Mprgp::Step::none);
    }
}

TEST_CASE("a product with noise of 1e-8 ends at that level") {
  Random random(8), noise(9);
  const int n = 80;
  const DenseMatrix A = test::random_matrix(random, n, 1e-2);
  for (const Shape shape : {Shape::none, Shape::box, Shape::discs}) {
    CAPTURE(int(shape));
    const KnownMinimum known = test::known_minimum(random, n, shape, 0.3);
    const Vector b = A * known.x - known.g;
    const auto noisy = [&](const Vector& v) -> Vector { return A * v + 1e-8 * v.norm() / std::sqrt(n) * noise.vector(n); };
    Mprgp method(noisy, 1, b, known.set, Vector::Zero(n));
    test::minimise(method, below(1e-12, 20000));
    CHECK(method.halt() == Halt::rounding);
    CHECK(method.projected_gradient_norm() <= 1e-6);
  }
}

TEST_CASE("numbers that are not finite end it at the last good x") {
  const DenseMatrix A = DenseMatrix::Identity(3, 3);
  const SeparableSet set(Vector::Zero(3), Vector::Ones(3));
  for (const int good : {0, 1, 2}) {
    int calls = 0;
    const auto bad = [&](const Vector& v) -> Vector { return calls++ < good ? v : Vector(std::nan("") * v); };
    Mprgp method(bad, 1, Vector{{0.9, 0.5, 7}}, set, Vector::Constant(3, 0.1));
    test::minimise(method, below(0));
    CHECK(method.halt() == Halt::not_finite);
    CHECK(set.contains(method.x()));
    CHECK(method.step() == Mprgp::Step::none);
  }
}

TEST_CASE("a norm that is too small is noticed and raised") {
  for (const Shape shape : kShapes)
    for (const auto expansion : {solver::MprgpSettings::Expansion::fixed_step, solver::MprgpSettings::Expansion::projected_cg_step}) {
      CAPTURE(int(shape));
      Random random(10);
      const DenseMatrix A = test::random_matrix(random, 90, 1e-2);
      const KnownMinimum known = test::known_minimum(random, 90, shape);
      const Vector b = A * known.x - known.g;
      Mprgp method(map(A), 1e-3, b, known.set, Vector::Zero(90), {.expansion = expansion});
      test::minimise(method, below(1e-10 * b.norm()));
      CHECK(method.halt() == Halt::none);
      CHECK((method.x() - known.x).norm() <= 1.5e-10 * b.norm() / 1e-2);
      CHECK(method.norm() > 0.1);
      CHECK(method.norm() <= 1.1);
    }
}

TEST_CASE("a preconditioner is applied in the face") {
  // A = D A₀ D with D over four orders; M = D⁻².
  Random random(12);
  const int n = 120;
  Vector d(n);
  for (int i = 0; i < n; ++i) d[i] = std::pow(10.0, -2 * random.between(0, 1));
  DenseMatrix A = d.asDiagonal() * test::random_matrix(random, n, 0.05) * d.asDiagonal();
  const Vector weight = d.cwiseAbs2().cwiseInverse();
  for (const Shape shape : {Shape::none, Shape::low, Shape::box, Shape::mixed, Shape::discs}) {
    CAPTURE(int(shape));
    const KnownMinimum known = test::known_minimum(random, n, shape);
    // Slight pushes against circles: their curvature is not in M.
    const Vector b = A * known.x - (known.set.has_discs() ? 1e-5 : 1) * known.g;
    const auto M = [&](const Vector& v, const Vector&, const SeparableSet::Gradients&) -> Vector { return weight.cwiseProduct(v); };
    Mprgp plain(map(A), 1, b, known.set, Vector::Zero(n)), better(map(A), 1, b, known.set, Vector::Zero(n), {.preconditioner = M});
    test::minimise(plain, below(1e-9 * b.norm()));
    test::minimise(better, below(1e-9 * b.norm()));
    CHECK(better.halt() == Halt::none);
    CHECK((better.x() - known.x).norm() <= 1.5e-9 * b.norm() / (1e-4 * 0.05));
    CHECK(2 * better.products() <= plain.products());
  }
}

TEST_CASE("nothing to minimise over: empty, all fixed, zero matrix") {
  const DenseMatrix none(0, 0);
  const SeparableSet empty(Vector(0), Vector(0));
  Mprgp nothing(map(none), 0, Vector(0), empty, Vector(0));
  test::minimise(nothing, below(-1));
  CHECK(nothing.halt() == Halt::solved);

  const DenseMatrix one = DenseMatrix::Identity(4, 4), zero = DenseMatrix::Zero(4, 4);
  const SeparableSet fixed(Vector{{1, 2, -test::kNoEnd, -test::kNoEnd}}, Vector{{1, 2, test::kNoEnd, test::kNoEnd}}, {{2, 3, {3, 4}, 0}});
  Mprgp held(map(one), 1, Vector::Ones(4), fixed, Vector::Zero(4));
  test::minimise(held, below(-1));
  CHECK(held.halt() == Halt::solved);
  CHECK(held.x() == Vector{{1, 2, 3, 4}});

  const SeparableSet box(Vector::Constant(4, -1), Vector::Constant(4, 2));
  Mprgp linear(map(zero), 0, Vector{{1, -1, 0, 3}}, box, Vector::Zero(4));
  test::minimise(linear, below(-1));
  CHECK(linear.halt() == Halt::solved);
  CHECK(linear.x() == Vector{{2, -1, 0, 2}});
}

TEST_CASE("it goes on from x with another b, the gradient changed by hand") {
  Random random(13);
  const int n = 60;
  const DenseMatrix A = test::random_matrix(random, n, 1e-2);
  const KnownMinimum known = test::known_minimum(random, n, Shape::mixed);
  const Vector b = A * known.x - known.g, change = random.vector(n);
  Mprgp method(map(A), 1, b + change, known.set, Vector::Zero(n));
  test::minimise(method, below(1e-3));
  const int products = method.products();
  method.restart(b, 1, method.g() + change);
  CHECK(method.products() == products);
  CHECK((A * method.x() - b - method.g()).norm() <= 1e-13 * b.norm());
  test::minimise(method, below(1e-11));
  CHECK((method.x() - known.x).norm() <= 2e-9);
}
