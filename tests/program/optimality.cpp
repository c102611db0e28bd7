#include <doctest/doctest.h>

#include "algebra/dense/decompositions.hpp"
#include "programs.hpp"

using namespace dotyk;
using test::DenseMatrix;
using test::Random;
using test::Vector;

TEST_CASE("small programs: every method finds what enumeration finds") {
  Random random(301);
  Monitor quiet;
  for (int trial = 0; trial < 150; ++trial) {
    const int n = 1 + trial % 3, rows = trial % 4;
    const auto p = test::boxed(random, n, rows, trial % (n + 1));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    const double close = 1e-8 * (1 + std::abs(*exact));
    const auto one = program::solve(p, test::one(), quiet), many = program::solve(p, test::many(), quiet);
    const auto interior = program::solve(p, program::InteriorPoint{}, quiet);
    INFO(trial << ": " << one.reason << ", " << many.reason << ", " << interior.reason);
    REQUIRE(one.status == program::Status::solved);
    REQUIRE(many.status == program::Status::solved);
    REQUIRE(interior.status == program::Status::solved);
    CHECK(std::abs(one.objective - *exact) <= close);
    CHECK(std::abs(many.objective - *exact) <= close);
    CHECK(std::abs(interior.objective - *exact) <= 10 * close);
  }
}

TEST_CASE("programs of some size: optimality conditions hold, from cold and from a prediction") {
  Random random(302);
  Monitor quiet;
  for (int trial = 0; trial < 120; ++trial) {
    const int n = 5 + trial % 30, rows = trial % 25;
    const auto p = test::boxed(random, n, rows, trial % (n + 1));
    double objective = NAN;
    for (const auto start : {program::ActiveSet::Start::cold, program::ActiveSet::Start::interior_point})
      for (auto settings : {test::one(), test::many()}) {
        settings.start = start;
        const auto r = program::solve(p, settings, quiet);
        INFO(trial << ": " << r.reason);
        REQUIRE(r.status == program::Status::solved);
        CHECK(test::worst(r.residual) < 1e-8);
        CHECK(r.survived == r.singular);
        if (!std::isnan(objective)) CHECK(std::abs(r.objective - objective) <= 1e-8 * (1 + std::abs(objective)));
        objective = r.objective;
        for (int k = 0; k < p.rows(); ++k)
          if (r.working[k] == program::Side::free) CHECK(std::abs(r.y[k]) == 0);
      }
  }
}

TEST_CASE("the size of the objective does not matter, to any method") {
  Random random(305);
  Monitor quiet;
  for (int trial = 0; trial < 10; ++trial) {
    const auto p = test::boxed(random, 4, 3, 4);
    const Vector known = program::solve(p, test::one(), quiet).x;
    for (const double size : {1e-300, 1e-99, 1e-20, 1e20, 1e99, 1e300}) {
      INFO(trial << ": " << size);
      auto other = p;
      other.P *= size, other.q *= size;
      for (const auto& r : {program::solve(other, test::one(), quiet), program::solve(other, test::many(), quiet),
                            program::solve(other, program::InteriorPoint{}, quiet)}) {
        REQUIRE_MESSAGE(r.status == program::Status::solved, r.reason);
        CHECK((r.x - known).norm() <= 1e-5 * (1 + known.norm()));
      }
    }
  }
}

TEST_CASE("degenerate: more rows through the optimum than unknowns, and rows twice") {
  Random random(303);
  Monitor quiet;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + trial % 6, rows = 3 * n;
    const Vector optimum = random.vector(n);
    DenseMatrix A = random.matrix(rows, n);
    A.row(rows - 1) = A.row(0);
    A.row(rows - 2) = 2 * A.row(1);
    // A cone with its tip at the optimum: −q is a positive combination of the rows.
    const Vector high = A * optimum, weight = random.vector(rows).cwiseAbs();
    const DenseMatrix P = test::semidefinite(random, n, trial % (n + 1));
    const auto p = test::quadratic(P, -P * optimum - A.transpose() * weight, A, Vector::Constant(rows, -INFINITY), high);
    for (const auto& settings : {test::one(), test::many()}) {
      const auto r = program::solve(p, settings, quiet);
      INFO(trial << ": " << r.reason);
      REQUIRE(r.status == program::Status::solved);
      CHECK((r.x - optimum).norm() < 1e-7);
      CHECK(test::worst(r.residual) < 1e-8);
    }
  }
}

TEST_CASE("scales from 1e-6 to 1e6 in rows, unknowns and objective change nothing") {
  Random random(304);
  Monitor quiet;
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 6;
    auto p = test::boxed(random, n, 5, 3 + trial % 4);
    const auto plain = program::solve(p, test::one(), quiet);
    REQUIRE(plain.status == program::Status::solved);
    const auto power = [&] { return std::pow(10.0, random.below(13) - 6); };
    Vector column(n), row(p.rows());
    for (double& c : column) c = power();
    for (double& r : row) r = power();
    const double cost = power();
    auto q = p;
    q.P = test::lower(cost * column.asDiagonal() * test::full(p.P) * column.asDiagonal());
    q.q = cost * column.cwiseProduct(p.q);
    q.A = DenseMatrix(row.asDiagonal() * DenseMatrix(p.A) * column.asDiagonal()).sparseView(0, 0);
    q.low = row.cwiseProduct(p.low), q.high = row.cwiseProduct(p.high);
    const auto r = program::solve(q, test::one(), quiet);
    REQUIRE(r.status == program::Status::solved);
    CHECK(std::abs(r.objective / cost - plain.objective) <= 1e-7 * (1 + std::abs(plain.objective)));
  }
}

TEST_CASE("unknowns in other units, 1e-8 to 1e8 of them, are the same unknowns") {
  Random random(306);
  Monitor quiet;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 6;
    const auto p = test::boxed(random, n, trial % 5, n);
    const auto plain = program::solve(p, test::one(), quiet);
    REQUIRE(plain.status == program::Status::solved);
    Vector unit(n), row = Vector::Ones(p.rows());
    for (double& u : unit) u = std::pow(10.0, random.between(-8, 8));
    row.tail(n) = unit.cwiseInverse();
    auto other = p;
    other.P = test::lower(unit.asDiagonal() * test::full(p.P) * unit.asDiagonal());
    other.q = unit.cwiseProduct(p.q);
    other.A = DenseMatrix(row.asDiagonal() * DenseMatrix(p.A) * unit.asDiagonal()).sparseView(0, 0);
    other.low = row.cwiseProduct(p.low), other.high = row.cwiseProduct(p.high);
    for (const auto& settings : {test::one(), test::many()}) {
      const auto r = program::solve(other, settings, quiet);
      INFO(trial << ": " << r.reason);
      REQUIRE(r.status == program::Status::solved);
      CHECK((r.x.cwiseProduct(unit) - plain.x).norm() <= 1e-6 * (1 + plain.x.norm()));
    }
    const auto interior = program::solve(other, program::InteriorPoint{}, quiet);
    INFO(trial << ": " << interior.reason);
    if (interior.status == program::Status::solved)  // or it says that it did not get there
      CHECK((interior.x.cwiseProduct(unit) - plain.x).norm() <= 1e-6 * (1 + plain.x.norm()));
  }
}

TEST_CASE("the units of unknowns, rows and objective, 1e-6 to 1e6, do not matter where P is singular either") {
  Random random(308);
  Monitor quiet;
  const auto unit = [&] { return std::pow(10.0, random.between(-6, 6)); };
  for (int trial = 0; trial < 100; ++trial) {
    // Of x ≥ 0 and general rows as many hold, with multipliers, as P is short of rank: x is the only solution.
    const int n = 2 + trial % 6, rank = trial % n, general = n / 2, held = n - rank;
    DenseMatrix A(n + general, n);
    A << DenseMatrix::Identity(n, n), random.matrix(general, n);
    Vector x = random.vector(n).cwiseAbs().array() + 0.2, low = Vector::Zero(n + general), y = low;
    for (int j = 0; j < held; ++j) x[j] = 0, y[j] = -random.between(0.2, 1);
    low.tail(general) = A.bottomRows(general) * x;
    for (int r = n; r < n + general; ++r) low[r] -= random.between(0.2, 1);
    const DenseMatrix F = random.matrix(rank, n), P = F.transpose() * F;
    const Vector q = -P * x - A.transpose() * y;
    Vector column(n), row(n + general);
    for (double& u : column) u = unit();
    for (double& u : row) u = unit();
    row.head(n) = column.cwiseInverse();
    const double objective = unit();
    const auto p = test::quadratic(objective * column.asDiagonal() * P * column.asDiagonal(), objective * column.cwiseProduct(q),
                                   row.asDiagonal() * A * column.asDiagonal(), row.cwiseProduct(low), Vector::Constant(n + general, INFINITY));
    for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet),
                          program::solve(p, program::InteriorPoint{}, quiet)}) {
      INFO(trial << ": " << r.reason);
      REQUIRE(r.status == program::Status::solved);
      CHECK((r.x.cwiseProduct(column) - x).norm() <= 1e-7 * (1 + x.norm()));
    }
  }
}

TEST_CASE("an interior point method's unknowns are right to tol as well, not only their energy") {
  Random random(309);
  Monitor quiet;
  const int n = 130;
  for (int trial = 0; trial < 3; ++trial) {
    DenseMatrix F = DenseMatrix::Identity(n, n);
    for (int k = 0; k < 6 * n; ++k) F(random.below(n), random.below(n)) = random.between(-1, 1);
    Vector x(n), y(n);
    for (int j = 0; j < n; ++j) {
      const bool held = random.coin();
      x[j] = held ? 0 : random.between(0.3, 2), y[j] = held ? -random.between(0.2, 1) : 0;
    }
    const DenseMatrix P = F * F.transpose();
    const auto p = test::quadratic(P, -P * x - y, DenseMatrix::Identity(n, n), Vector::Zero(n), Vector::Constant(n, INFINITY));
    const auto r = program::solve(p, program::InteriorPoint{}, quiet);
    REQUIRE(r.status == program::Status::solved);
    CHECK((r.x - x).lpNorm<Eigen::Infinity>() < 1e-9);
  }
}

TEST_CASE("an unknown whose energy is nothing beside another's is found as well") {
  Monitor quiet;
  for (const double great : {1e6, 1e12}) {
    const auto p = test::quadratic(Vector{{great, 1 / great}}.asDiagonal(), Vector{{-great, -1 / great}}, DenseMatrix::Identity(2, 2), Vector::Zero(2),
                                   Vector::Constant(2, INFINITY));
    const auto interior = program::solve(p, program::InteriorPoint{}, quiet);
    for (const auto& r : {interior, program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet)}) {
      REQUIRE_MESSAGE(r.status == program::Status::solved, r.reason);
      CHECK((r.x - Vector::Ones(2)).lpNorm<Eigen::Infinity>() < 1e-6);
    }
  }
}

TEST_CASE("parts of a program, their energies 1e-8 to 1e8 of each other's and their units unlike, do not hide one another") {
  Random random(307);
  Monitor quiet;
  constexpr int trials = 200, parts = 2, of_part = 3, n = parts * of_part, together = 2;
  int by_active_sets = 0, by_interior_points = 0;
  for (int trial = 0; trial < trials; ++trial) {
    DenseMatrix P = DenseMatrix::Zero(n, n), A = DenseMatrix::Zero(n + together, n);
    Vector q(n), unit(n), exact(n), low = Vector::Constant(n + together, -INFINITY);
    A.topRows(n).setIdentity();
    for (int part = 0; part < n; part += of_part) {
      const DenseMatrix own = random.positive_definite(of_part, 0.2);
      const Vector pull = random.vector(of_part);
      for (int j = 0; j < of_part; ++j)
        if (random.coin()) low[part + j] = 0;
      const auto alone = program::solve(test::quadratic(own, pull, DenseMatrix::Identity(of_part, of_part), low.segment(part, of_part),
                                                        Vector::Constant(of_part, INFINITY)), test::one(), quiet);
      REQUIRE(alone.status == program::Status::solved);
      const double energy = std::pow(10.0, random.between(-8, 8));
      for (double& u : unit.segment(part, of_part)) u = std::pow(10.0, random.between(-4, 4));
      const auto units = unit.segment(part, of_part);
      P.block(part, part, of_part, of_part) = energy * units.asDiagonal() * own * units.asDiagonal();
      q.segment(part, of_part) = energy * units.cwiseProduct(pull);
      exact.segment(part, of_part) = alone.x.cwiseQuotient(units);
    }
    // Rows over all unknowns, which do not hold any.
    for (int r = n; r < n + together; ++r) A.row(r) = random.vector(n).cwiseProduct(unit).transpose(), low[r] = A.row(r).dot(exact) - random.between(0.1, 1);
    const auto p = test::quadratic(P, q, A, low, Vector::Constant(n + together, INFINITY));
    const auto right = [&](const program::Result& r) {
      if (r.status != program::Status::solved) return false;  // it says that it did not get there
      CHECK_MESSAGE((r.x - exact).cwiseProduct(unit).lpNorm<Eigen::Infinity>() < 1e-4, trial << ": " << r.reason);
      return true;
    };
    by_active_sets += right(program::solve(p, test::one(), quiet));
    by_interior_points += right(program::solve(p, program::InteriorPoint{}, quiet));
  }
  CHECK(by_active_sets >= 0.99 * trials);
  CHECK(by_interior_points >= 0.85 * trials);
}

TEST_CASE("unknowns that nothing drives may be 0") {
  Random random(311);
  Monitor quiet;
  int solved = 0;
  constexpr int trials = 100;
  for (int trial = 0; trial < trials; ++trial) {
    const int n = 2 + random.below(19);
    Vector q(n), curvature(n);
    DenseMatrix A = DenseMatrix::Identity(n, n);
    for (int i = 0; i < n; ++i) {
      q[i] = random.below(3) - 1, curvature[i] = random.between(1, 10);
      for (int j = 0; j < n; ++j)
        if (j != i && random.below(3) == 0) A(i, j) = random.below(3) - 1;
    }
    const auto p = test::quadratic(curvature.asDiagonal(), q, A, -Vector::Ones(n), Vector::Ones(n));
    const auto exact = program::solve(p, test::one(), quiet), interior = program::solve(p, program::InteriorPoint{}, quiet);
    REQUIRE(exact.status == program::Status::solved);
    solved += interior.status == program::Status::solved;
    if (interior.status == program::Status::solved) CHECK((interior.x - exact.x).lpNorm<Eigen::Infinity>() < 1e-6);
  }
  CHECK(solved >= trials - 1);
}

TEST_CASE("a program without rows, and one whose rows never matter") {
  Random random(305);
  Monitor quiet;
  const DenseMatrix P = random.positive_definite(5, 1);
  const Vector q = random.vector(5);
  const Vector exact = -algebra::Ldlt(P).solve(q);
  const auto bare = test::quadratic(P, q, DenseMatrix(0, 5), Vector(0), Vector(0));
  const auto loose = test::quadratic(P, q, DenseMatrix::Identity(5, 5), Vector::Constant(5, -INFINITY), Vector::Constant(5, 1e6));
  for (const auto& p : {bare, loose}) {
    CHECK((program::solve(p, test::one(), quiet).x - exact).norm() < 1e-12);
    CHECK((program::solve(p, program::InteriorPoint{}, quiet).x - exact).norm() < 1e-7);
  }
}

TEST_CASE("a solution that is nothing but rounding is one: rows are measured by what their multipliers move them by") {
  Monitor quiet;
  const auto p = test::quadratic(DenseMatrix::Constant(1, 1, 2), Vector::Ones(1), DenseMatrix::Identity(1, 1), Vector::Zero(1), Vector::Constant(1, INFINITY));
  for (const auto& r : {program::solve(p, test::one(), quiet), program::solve(p, test::many(), quiet), program::solve(p, program::InteriorPoint{}, quiet)}) {
    CHECK_MESSAGE(r.status == program::Status::solved, r.reason);
    CHECK(r.y[0] == doctest::Approx(-1));
  }
  CHECK(program::residuals(p, Vector::Constant(1, -1e-5), -Vector::Ones(1)).feasibility > 0.9);  // beyond rounding it is none
}

TEST_CASE("a point that breaks a row is no solution, however far apart the units of unknowns are") {
  Monitor quiet;
  for (const double unit : {1e-6, 1e-15, 1e-24, 1e-40}) {
    const auto p = test::quadratic(DenseMatrix{{unit, 0}, {0, 1 / unit}}, Vector{{-unit, -1 / unit}}, DenseMatrix{{1, 1}}, Vector{{-INFINITY}}, Vector{{1.0}});
    for (const auto& settings : {test::one(), test::many()}) {
      const auto found = program::solve(p, settings, quiet);
      if (found.status == program::Status::solved) CHECK(found.x[0] + found.x[1] <= 1 + 1e-6);
    }
  }
}
