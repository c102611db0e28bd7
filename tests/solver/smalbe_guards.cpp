// SMALBE that is stopped, started at the solution, preconditioned, or given what has no solution.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/known_equality.hpp"
#include "algebra/dense/decompositions.hpp"
#include "solver/bounded/smalbe.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::SeparableSet;
using solver::Smalbe;
using solver::SmalbeCaller;
using solver::SmalbeResult;
using solver::SmalbeState;
using Known = test::KnownEquality;
using test::kShapes;
using test::Shape;
using test::until;

namespace {

using End = SmalbeResult::End;
using Update = Smalbe::Update;

constexpr Update kUpdates[] = {Update::precision, Update::penalty};

Smalbe by(Update update) {
  Smalbe method;
  method.update = update;
  return method;
}

}  // namespace

TEST_CASE("asked for more than rounding leaves it ends, near the best there is") {
  for (const bool complementary : {false, true})
    for (const Shape shape : kShapes)
      for (const Update update : kUpdates)
        for (const double degenerate : {0.0, 0.5}) {
          CAPTURE(complementary);
          CAPTURE(int(shape));
          CAPTURE(int(update));
          CAPTURE(degenerate);
          const Known known(4, 80, 7, shape, 0.05, complementary, degenerate);
          const Vector zero = Vector::Zero(80);
          const SmalbeResult near = minimise(known.program(complementary), by(update), until(1e-12 * known.b.norm()), zero, zero);
          CHECK(near.end == End::done);
          const SmalbeResult r = minimise(known.program(complementary), by(update), until(0), zero, zero);
          CHECK((r.end == End::rounding || r.end == End::done));
          CHECK(r.gradient <= 1e-12 * known.b.norm());
          CHECK(r.equality <= 1e-12 * known.b.norm());
          CHECK(r.products <= 4 * near.products + 40);  // three times over to be sure that it is rounding
          CHECK((r.x - known.x).norm() <= 1e-9);
        }
}

TEST_CASE("products known but to some digits: tolerances above are met, those below end soon") {
  for (const Shape shape : kShapes)
    for (const Update update : kUpdates) {
      CAPTURE(int(shape));
      CAPTURE(int(update));
      const Known known(4, 100, 8, shape, 0.02, true, 0.3);
      const Vector zero = Vector::Zero(100);
      test::Random random(3);
      const auto noisy = [&](double noise) {
        auto program = known.program(true);
        program.H = [&, noise](const Vector& v) -> Vector {
          const Vector y = known.H * v + 0.1 * noise * v.norm() * random.vector(100);
          return y - known.Q * y;
        };
        return program;
      };
      const double size = known.b.norm();
      const SmalbeResult precise = minimise(noisy(1e-12), by(update), until(1e-11 * size), zero, zero);
      CHECK(precise.end == End::done);
      const SmalbeResult coarse = minimise(noisy(1e-9), by(update), until(1e-11 * size), zero, zero);
      CHECK(coarse.end == End::rounding);
      CHECK(coarse.gradient <= 1e-8 * size);
      CHECK(coarse.equality <= 1e-8 * size);
      CHECK(coarse.products <= 1000);  // 95 to 576
    }
}

TEST_CASE("who watches sees every step, and may stop it") {
  const Known known(5, 60, 5, Shape::mixed, 0.05, true);
  const Vector zero = Vector::Zero(60);
  for (const Update update : kUpdates) {
    int inner = 0, outer = 0;
    SmalbeCaller caller = until(1e-8 * known.b.norm());
    caller.inner = [&](const SmalbeState& s) {
      ++inner;
      CHECK(s.outer == outer);
      CHECK(known.set->contains(s.inner.x()));
      CHECK(s.equality == doctest::Approx((known.Q * s.inner.x()).norm()));
      return true;
    };
    caller.outer = [&](const SmalbeState& s) {
      CHECK(s.outer == ++outer);
      CHECK(s.gradient <= s.M * s.equality);
    };
    const SmalbeResult r = minimise(known.program(true), by(update), caller, zero, zero);
    CHECK(r.end == End::done);
    CHECK(r.inner == inner);
    CHECK(r.outer == outer);

    inner = 0;
    caller = until(0);
    caller.inner = [&](const SmalbeState&) { return ++inner < 7; };
    const SmalbeResult stopped = minimise(known.program(true), by(update), caller, zero, zero);
    CHECK(stopped.end == End::stopped);
    CHECK(stopped.inner == 7);
    CHECK(known.set->contains(stopped.x));

    Smalbe few = by(update);
    few.max_inner = 9;
    CHECK(minimise(known.program(true), few, until(0), zero, zero).end == End::limit);
    few = by(update);
    few.max_outer = 2;
    const SmalbeResult short_run = minimise(known.program(true), few, until(0), zero, zero);
    CHECK(short_run.end == End::limit);
    CHECK(short_run.outer == 2);
  }
}

TEST_CASE("started at a solution and its multiplier it has nothing to do") {
  for (const Update update : kUpdates) {
    const Known known(6, 80, 6, Shape::mixed, 0.02, true);
    const Vector zero = Vector::Zero(80);
    const double small = 1e-9 * known.b.norm();
    const SmalbeResult first = minimise(known.program(true), by(update), until(small), zero, zero);
    const SmalbeResult again = minimise(known.program(true), by(update), until(1.01 * small), first.x, first.nu);
    CHECK(again.end == End::done);
    CHECK(again.inner <= 3);  // first.nu leaves out what ρQx adds to g here
    CHECK(again.products <= 6);
  }
}

TEST_CASE("no point of Ω has Qx = 0: proven") {
  const int n = 30;
  const Vector ones = Vector::Ones(n) / std::sqrt(double(n));
  test::Random random(7);
  const DenseMatrix H = test::random_matrix(random, n, 0.1);
  const SeparableSet positive(Vector::Constant(n, 0.1), Vector::Constant(n, test::kNoEnd));
  std::vector<SeparableSet::Disc> away;
  for (int i = 0; i < n; i += 2) away.push_back({i, i + 1, {1, 1}, 1.2});
  const SeparableSet discs(Vector::Constant(n, -test::kNoEnd), Vector::Constant(n, test::kNoEnd), away);
  for (const SeparableSet* set : {&positive, &discs})
    for (const Update update : kUpdates) {
      const solver::EqualityProgram program{test::map(H), 1, [&](const Vector& v) -> Vector { return ones.dot(v) * ones; }, false, random.vector(n), set};
      const SmalbeResult r = minimise(program, by(update), until(1e-8), Vector::Zero(n), Vector::Zero(n));
      CHECK(r.end == End::infeasible);
      CHECK(r.outer <= 50);
    }
}

TEST_CASE("what falls for ever, and what is no number, is told") {
  const int n = 10;
  DenseMatrix H = DenseMatrix::Identity(n, n);
  H(9, 9) = 0;
  const SeparableSet all(Vector::Constant(n, -test::kNoEnd), Vector::Constant(n, test::kNoEnd));
  const Vector zero = Vector::Zero(n), e = Vector::Unit(n, 0);
  const auto Q = [&](const Vector& v) -> Vector { return v.dot(e) * e; };
  for (const Update update : kUpdates) {
    CHECK(minimise({test::map(H), 1, Q, false, Vector::Ones(n), &all}, by(update), until(1e-9), zero, zero).end == End::unbounded);
    int calls = 0;
    const auto bad = [&](const Vector& v) -> Vector { return calls++ < 1 ? Vector(H * v) : Vector(std::nan("") * v); };
    CHECK(minimise({bad, 1, Q, false, Vector::Ones(n), &all}, by(update), until(1e-9), zero, zero).end == End::not_finite);
  }
}

TEST_CASE("a preconditioner is told the penalty that it is for") {
  // H = N S N^T on the kernel of Q; its pseudoinverse, exact: without bounds a step or two are enough.
  for (const double rho : {1.0, 100.0}) {
    for (const Shape shape : {Shape::none, Shape::low}) {
      const Known known(9, 120, 10, shape, 1e-3, true);
      const DenseMatrix inverse = algebra::MinimumNorm(known.H).solve(DenseMatrix(DenseMatrix::Identity(known.H.rows(), known.H.rows())));
      const Vector zero = Vector::Zero(120);
      Smalbe plain, better;
      plain.rho = better.rho = rho;
      const auto Q = known.program(true).Q;
      better.preconditioner = [&](const Vector& v, const Vector&, const SeparableSet::Gradients&, double penalty) -> Vector {
        return inverse * v + Q(v) / penalty;
      };
      const auto caller = until(1e-8 * known.b.norm());
      const SmalbeResult a = minimise(known.program(true), plain, caller, zero, zero);
      const SmalbeResult b = minimise(known.program(true), better, caller, zero, zero);
      CHECK(a.end == End::done);
      CHECK(b.end == End::done);
      CHECK((a.x - b.x).norm() <= 1e-4);
      if (shape == Shape::none) CHECK(b.inner <= 3);
    }
  }
}
