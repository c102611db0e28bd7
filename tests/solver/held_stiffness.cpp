#include <doctest/doctest.h>

#include "../multigrid/built.hpp"
#include "../support/programs.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/active/held_stiffness.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("the resistance that comes with a solution is the product with the stiffness, held unknowns included") {
  constexpr int kUnknowns = 20, kRows = 8;
  test::Random random(405);
  Monitor quiet;
  for (int trial = 0; trial < 50; ++trial) {
    DenseMatrix B = DenseMatrix::Zero(kRows, kUnknowns);
    for (int r = 0; r < kRows; ++r) B(r, 2 * r) = random.between(0.5, 1.5), B(r, 2 * r + 1) = r % 2 ? random.between(-1, 1) : 0;  // jumps, and one unknown
    auto p = test::program(random.positive_definite(kUnknowns, 0.3), random.vector(kUnknowns), B, Vector::Zero(kRows));
    p.groups = {test::group(problem::unilateral(), 0, kRows)};
    solver::HeldStiffness stiffness(p, problem::rigid_motions(p), solver::incomplete_factor(), quiet);
    const auto& T = stiffness.basis().T;
    for (int set = 0; set < 3; ++set) {
      Vector spring = Vector::Zero(kRows), at_held = Vector::Zero(kUnknowns);
      std::vector<char> held(kUnknowns, 0);
      for (int r = 0; r < kRows; ++r) {
        const int own = stiffness.basis().unknown[r];
        if (own < 0 || (r + set) % 3 == 2) spring[r] = random.between(0.1, 10);
        else held[own] = (r + set) % 3 == 0, at_held[own] = random.between(-1, 1);
      }
      REQUIRE(stiffness.factor(spring, held));
      const auto product = [&](const Vector& u) { return Vector(T.transpose() * problem::stiffness_times(p, u)); };
      const auto by = stiffness.solve_in_basis(random.vector(kUnknowns), 1e-14);
      REQUIRE(by.resistance.size() == kUnknowns);
      CHECK((by.resistance - product(by.u)).norm() <= 1e-12 * product(by.u).norm());
      CHECK((stiffness.resistance_of_watched(at_held) - product(T * at_held)).norm() <= 1e-12 * product(T * at_held).norm() + 1e-13);
    }
  }
}

TEST_CASE("where rows have one unknown each, of either sign, multigrid solves as a factor does") {
  if (test::not_built()) return;
  constexpr int kUnknowns = 20, kRows = 8;
  test::Random random(83);
  Monitor quiet;
  DenseMatrix B = DenseMatrix::Zero(kRows, kUnknowns);
  for (int r = 0; r < kRows; ++r) B(r, 2 * r) = r % 3 ? -1 : 1;
  auto p = test::program(random.positive_definite(kUnknowns, 0.3), random.vector(kUnknowns), B, Vector::Zero(kRows));
  p.groups = {test::group(problem::unilateral(), 0, kRows)};
  const auto rigid = problem::rigid_motions(p);
  solver::HeldStiffness factored(p, rigid, solver::factor(algebra::Ordering::automatic), quiet), iterated(p, rigid, solver::multigrid(solver::Levels::aggregates), quiet);
  REQUIRE(iterated.basis().of_signs());
  REQUIRE_FALSE(iterated.basis().trivial());
  for (int set = 0; set < 4; ++set) {
    Vector spring = Vector::Zero(kRows);
    std::vector<char> held(kUnknowns, 0);
    for (int r = 0; r < kRows; ++r) {
      if ((r + set) % 3 == 0) held[iterated.basis().unknown[r]] = 1;
      else if ((r + set) % 3 == 1) spring[r] = random.between(0.1, 10);
    }
    REQUIRE(factored.factor(spring, held));
    REQUIRE(iterated.factor(spring, held));
    const Vector b = random.vector(kUnknowns);
    const auto by = iterated.solve_in_basis(b, 1e-14);
    const Vector u = factored.solve_in_basis(b).u, resistance = iterated.basis().forces(problem::stiffness_times(p, u));
    CHECK((by.u - u).norm() <= 1e-11 * u.norm());  // the condition, below 1000, times the tolerance
    REQUIRE(by.resistance.size() == kUnknowns);
    CHECK((by.resistance - resistance).norm() <= 1e-11 * resistance.norm());
  }
}
