#include "problem/residual.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/chain.hpp"

using namespace dotyk;
using namespace dotyk::problem;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// One unknown of stiffness 2 under force f, stopped at the gap c.
Problem one_spring(double f, double c, std::shared_ptr<const Law> law) {
  Problem p;
  Block b;
  b.name = "spring";
  b.K = test::lower(DenseMatrix::Constant(1, 1, 2));
  b.f = Vector::Constant(1, f);
  b.node = {0};
  b.kernel.resize(1, 0);
  add(p, b);
  p.B = test::rows(DenseMatrix::Ones(1, 1));
  p.c = Vector::Constant(1, c);
  p.groups.push_back(test::group(law, 0, 1));
  return p;
}

State state(double u, double lambda) { return {Vector::Constant(1, u), Vector::Constant(1, lambda)}; }

}  // namespace

TEST_CASE("residuals vanish at the solution of one spring and an obstacle") {
  // Closed: u = c, λ = f − 2c. Open: u = f/2.
  for (const auto& [p, s] : {std::pair{one_spring(10, 1, unilateral()), state(1, 8)},
                             std::pair{one_spring(10, 6, unilateral()), state(5, 0)},
                             std::pair{one_spring(-10, 1, bilateral()), state(1, -12)},
                             std::pair{one_spring(10, 0, elastic({3})), state(2, 6)}}) {
    const Residual r = residual(p, s);
    CHECK(r.equilibrium == 0);
    CHECK(r.penetration == 0);
    CHECK(r.complementarity == 0);
    CHECK(r.law < 1e-15);
  }
}

TEST_CASE("each residual sees its own violation, relative to its scale") {
  const Problem p = one_spring(10, 1, unilateral());
  // u = 1.1 penetrates by 0.1 of 5, which the load moves the spring by; λ = 10 − 2.2 keeps equilibrium.
  const Residual deep = residual(p, state(1.1, 7.8));
  CHECK(deep.equilibrium < 1e-15);
  CHECK(deep.penetration == doctest::Approx(0.1 / 5));
  CHECK(deep.complementarity > 0.01);
  CHECK(deep.law > 0.01);
  // u = 1 with the wrong force misses equilibrium by 3 of the load of 10.
  const Residual off = residual(p, state(1, 5));
  CHECK(off.equilibrium == doctest::Approx(0.3));
  CHECK(off.penetration == 0);
  // Pulling.
  CHECK(residual(one_spring(1, 1, unilateral()), state(1, -1)).law == doctest::Approx(1));
}

TEST_CASE("a row whose gap is huge does not hide the penetration of another") {
  Problem p = one_spring(10, 1, unilateral());
  p.B = test::rows(DenseMatrix::Ones(2, 1));
  p.c = Vector{{1, 1e30}};
  p.groups = {test::group(unilateral(), 0, 2)};
  CHECK(residual(p, {Vector::Constant(1, 1.1), Vector{{7.8, 0}}}).penetration == doctest::Approx(0.1 / 5));
}

TEST_CASE("residuals do not depend on units") {
  for (double force : {1e-6, 1.0, 1e9})
    for (double length : {1e-6, 1.0, 1e3}) {
      Problem p = one_spring(10 * force, 1 * length, unilateral());
      p.blocks[0].K = algebra::SparseMatrix((force / length) * p.blocks[0].K.lower());
      const Residual r = residual(p, state(1.1 * length, 5 * force)),
                     reference = residual(one_spring(10, 1, unilateral()), state(1.1, 5));
      CHECK(r.equilibrium == doctest::Approx(reference.equilibrium));
      CHECK(r.penetration == doctest::Approx(reference.penetration));
      CHECK(r.complementarity == doctest::Approx(reference.complementarity));
      CHECK(r.law == doctest::Approx(reference.law));
    }
}

TEST_CASE("the residual of the laws does not depend on the size of the load or of the stiffness, and sees each law") {
  // One unknown of stiffness 2k under f; u is off the law by a tenth.
  const auto law_at = [](double f, double k, const std::shared_ptr<const Law>& law, double u, double lambda) {
    Problem p = one_spring(f, 0, law);
    p.blocks[0].K = algebra::SparseMatrix(k * p.blocks[0].K.lower());
    return residual(p, state(u, lambda)).law;
  };
  for (const double f : {1e-9, 1.0, 1e12})
    for (const double k : {1e-6, 1.0, 1e9}) {
      const double u = f / (5 * k), lambda = 3 * f / 5;  // held by an elastic row of 3k: 2ku + 3ku = f
      CHECK(law_at(f, k, elastic({3 * k}), u, lambda) < 1e-15);
      CHECK(law_at(f, k, elastic({3 * k}), u, 0.9 * lambda) == doctest::Approx(law_at(1, 1, elastic({3}), 0.2, 0.54)));
      CHECK(law_at(f, k, elastic({3 * k}), u, 0.9 * lambda) > 0.01);
      CHECK(law_at(f, k, bilateral(), 0.1 * u, lambda) == doctest::Approx(law_at(1, 1, bilateral(), 0.02, 0.6)));
      CHECK(law_at(f, k, limited("capped", {{3 * k, -0.5 * f, 0.5 * f}}), u, lambda) == doctest::Approx(0.1));  // of F = f
    }
}

TEST_CASE("multipliers and gaps that are rounding violate no law") {
  // Nothing touches, and what an iteration left of λ is no force beside the load.
  CHECK(residual(one_spring(-10, 1, unilateral()), state(-5, 1e-12)).law < 1e-12);
  // A row that holds far from where the body was, by a displacement of 1e9: its gap is rounding, however stiff the row.
  Problem far = one_spring(0, 1e9, bilateral());
  far.blocks[0].K = algebra::SparseMatrix(1e6 * far.blocks[0].K.lower());
  CHECK(residual(far, state(1e9 * (1 + 1e-15), -2e15)).law < 1e-14);
}

TEST_CASE("great multipliers and slip do not judge themselves: forces and displacements that count are those of the data") {
  // Two walls hold one unknown at 1 and at 2, with forces that balance each other: no state is right, however great the forces.
  for (const double force : {1.0, 1e6, 1e12}) {
    Problem walls = one_spring(0, 0, bilateral());
    walls.B = test::rows(DenseMatrix{{1}, {-1}});
    walls.c = Vector{{1, -2}};
    walls.groups = {test::group(bilateral(), 0, 2)};
    const Residual r = residual(walls, {Vector::Constant(1, 1.5), Vector{{force, force + 3}}});
    CHECK(r.equilibrium < 1e-3);
    CHECK(r.law > 0.1);
  }
  // Friction beyond its bound, by a tenth of the load.
  Problem block = one_spring(10, 0, bilateral());
  block.groups.clear();
  block.friction = {{"friction", tresca({4}), 0, 1, {-1}}};
  CHECK(residual(block, state(3, 4)).laws() < 1e-15);
  CHECK(residual(block, state(2.5, 5)).friction == doctest::Approx(0.1));
  CHECK(residual(block, state(2.5, 5)).laws() >= 0.1);
  // Nor does the friction of a history that has ended without load: the slip before drives it.
  Problem unloaded = one_spring(0, 0.5, bilateral());
  unloaded.groups.clear();
  unloaded.friction = {{"friction", tresca({4}), 0, 1, {-1}}};
  CHECK(residual(unloaded, state(1e-17, -1e-17)).laws() > 0.1);  // it sticks at 0.5, by 1
  CHECK(residual(unloaded, state(0.5, -1)).laws() < 1e-15);
}

TEST_CASE("energy is the minimum at the solution") {
  test::Random random(51);
  const Problem p = one_spring(10, 0.5, elastic({3}));
  const double u = (10 + 3 * 0.5) / 5;  // 2u + 3(u − 0.5) = 10
  const double least = energy(p, state(u, 3 * (u - 0.5)));
  CHECK(least == doctest::Approx(u * u - 10 * u + 1.5 * (u - 0.5) * (u - 0.5)));
  for (int k = 0; k < 20; ++k) CHECK(energy(p, state(u + random.between(-1, 1), 0)) > least);
}

TEST_CASE("nothing loaded and nothing moved has no residual") {
  const Residual r = residual(one_spring(0, 0, unilateral()), state(0, 0));
  CHECK(r.equilibrium + r.penetration + r.complementarity + r.law == 0);
}

TEST_CASE("rounding is no force where nothing loads: neither equilibrium nor complementarity are measured by it") {
  // A bar that has moved out of an obstacle's way, by u = (0.1, 0.1) but for the last digit.
  const auto moved = [](double load, double difference, double lambda) {
    Problem p;
    Block bar;
    bar.name = "bar";
    bar.K = test::lower((DenseMatrix(2, 2) << 1000, -1000, -1000, 1000).finished());
    bar.f = load * Vector::Ones(2);
    bar.node = {0, 1};
    bar.kernel = DenseMatrix::Ones(2, 1);
    add(p, bar);
    p.B = test::rows(DenseMatrix::Identity(1, 2));
    p.c = Vector::Constant(1, 0.1);
    p.groups.push_back(test::group(unilateral(), 0, 1));
    return residual(p, {Vector{{0.1, 0.1 + difference}}, Vector::Constant(1, lambda)});
  };
  CHECK(moved(0, 1e-17, 1e-15).equilibrium < 1e-6);
  CHECK(moved(1e-15, 1e-17, 1e-15).equilibrium > 0.1);  // beside a load, however small, it is
  CHECK(moved(0, 1e-6, 0).equilibrium > 100);  // and strains are no rounding
  CHECK(moved(0, 0, 1e-3).equilibrium == doctest::Approx(1));
}

TEST_CASE("row stiffness is that of the bodies one after the other") {
  Problem p = one_spring(1, 1, unilateral());
  p.B = test::rows(DenseMatrix::Constant(1, 1, -3));
  CHECK(p.row_stiffness()[0] == doctest::Approx(2.0 / 9));  // a unit of the row's force is 3 on the unknown, whose 1.5 are 4.5 of the row
  CHECK(p.group_of_rows()[0] == &p.groups[0]);
}

TEST_CASE("how far a body moves as a whole is no measure of its gaps") {
  // A bar of stiffness C, pushed by 1 against a wall a million away: λ = 1, u = (10⁶, 10⁶ + 1/C).
  const double C = 1000, away = 1e6;
  Problem p;
  Block bar;
  bar.name = "bar";
  bar.K = test::lower((DenseMatrix(2, 2) << C, -C, -C, C).finished());
  bar.f = Vector::Unit(2, 1);
  bar.node = {0, 1};
  bar.kernel = DenseMatrix::Ones(2, 1);
  add(p, bar);
  p.B = test::rows(DenseMatrix::Identity(1, 2));
  p.c = Vector::Constant(1, away);
  p.groups.push_back(test::group(unilateral(), 0, 1));
  const auto beyond = [&](double by) { return residual(p, {Vector{{away + by, away + by + 1 / C}}, Vector::Ones(1)}).laws(); };
  CHECK(beyond(0) == 0);
  CHECK(beyond(1e-9) == 0);  // 10⁶ is known to no more
  p.c[0] = 0;  // a gap is a measure of its own row
  CHECK(residual(p, {Vector{{1e-5, 1e-5 + 1 / C}}, Vector::Ones(1)}).laws() > 1e-3);
  p.c[0] = -1e-3;
  CHECK(residual(p, {Vector{{-1e-3 + 1e-5, -1e-3 + 1e-5 + 1 / C}}, Vector::Ones(1)}).laws() > 1e-3);
  // Open by ten or by 10⁶ lengths, a force there counts by itself.
  p.c[0] = 0;
  for (const double open : {10 / C, 1e6 / C}) {
    const double laws = residual(p, {Vector{{-open, -open + 1 / C}}, Vector::Constant(1, 1e-9)}).laws();
    CHECK(laws > 1e-10);
    CHECK(laws < 1e-8);
  }
}

TEST_CASE("rounding of a motion as a whole is told from forces out of balance and from wrong strains") {
  // A bar of stiffness C, pushed by 1 onto a spring of stiffness 7: λ = 1, u = (1/7, 1/7 + 1/C).
  const double C = 3e12, seventh = 1.0 / 7;
  Problem p;
  Block bar;
  bar.name = "bar";
  bar.K = test::lower((DenseMatrix(2, 2) << C, -C, -C, C).finished());
  bar.f = Vector::Unit(2, 1);
  bar.node = {0, 1};
  bar.kernel = DenseMatrix::Ones(2, 1);
  add(p, bar);
  p.B = test::rows(DenseMatrix::Identity(1, 2));
  p.c = Vector::Zero(1);
  p.groups.push_back(test::group(elastic({7}), 0, 1));
  const auto at = [&](double strain, double lambda) {
    return State{Vector{{seventh, seventh + strain / C}}, Vector::Constant(1, lambda)};
  };
  const State right = at(1, 1);
  CHECK(residual(p, right).equilibrium > 1e-6);  // u has 16 digits, its difference 4
  CHECK(motion_residual(p, right).beyond == 0);
  CHECK(motion_residual(p, right).resultants == 0);
  CHECK(motion_residual(p, right).most == 0);
  CHECK(motion_residual(p, at(1, 1.001)).resultants == doctest::Approx(0.001 / 2.001));
  CHECK(motion_residual(p, at(1.1, 1)).beyond > 0.01);
  p.blocks[0].kernel.resize(2, 0);  // of a body that is held nothing is granted
  CHECK(motion_residual(p, right).beyond == residual(p, right).equilibrium);
  CHECK(motion_residual(p, right).most == -1);
}
