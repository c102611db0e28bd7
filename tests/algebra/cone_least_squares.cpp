#include "algebra/dense/cone_least_squares.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "algebra/dense/bounded_least_squares.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"

using namespace dotyk;
using algebra::ConvexSet;
using algebra::DenseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A tower of squares with three points in each joint, every point a row of (translation along x, along y, rotation by the corner's way).
SparseRows tower(int bodies, bool tangential) {
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (int b = 0; b < bodies; ++b)
    for (double at : {-1.0, 0.0, 1.0}) {
      for (const int own : {b, b - 1}) {
        if (own < 0) continue;
        const double sign = own == b ? -1 : 1, foot = own == b ? 1 : -1;
        entries.emplace_back(row, 3 * own + 1, sign), entries.emplace_back(row, 3 * own + 2, sign * at);
        if (tangential) entries.emplace_back(row + 1, 3 * own, sign), entries.emplace_back(row + 1, 3 * own + 2, sign * foot);
      }
      row += tangential ? 2 : 1;
    }
  SparseRows A(row, 3 * bodies);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

class Stopped final : public Monitor {
  bool stop() override { return true; }
};

/// Points that press, or that rub as well.
ConvexSet held_by(int points, double mu) {
  ConvexSet set;
  const auto count = static_cast<std::size_t>(points);
  if (mu > 0) set.rounds.assign(count, {1, 0, mu});
  else set.low.assign(count, 0), set.high.assign(count, kInfinity);
  return set;
}

}  // namespace

TEST_CASE("intervals and plane cones: the residual of dense active sets") {
  std::mt19937 engine(3);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const int modes = 1 + trial % 9, bounded = trial % 7, cones = trial % 5;
    const int rows = bounded + 2 * cones;
    DenseMatrix A = DenseMatrix::NullaryExpr(rows, modes, [&] { return uniform(0, 1) < 0.5 ? 0.0 : std::round(uniform(-4, 4)) / 4; });
    ConvexSet set;
    DenseMatrix columns(modes, rows);
    Vector low = Vector::Zero(rows), high = Vector::Constant(rows, kInfinity);
    for (int k = 0; k < bounded; ++k) {
      const int kind = static_cast<int>(engine() % 4);
      set.low.push_back(kind == 0 ? -kInfinity : kind == 1 ? -uniform(0, 1) : 0);
      set.high.push_back(kind == 3 ? uniform(0, 1) : kInfinity);
      low[k] = set.low.back(), high[k] = set.high.back();
      columns.col(k) = A.row(k).transpose();
    }
    for (int k = 0; k < cones; ++k) {
      const int n = bounded + 2 * k;
      const double slope = uniform(0.1, 1);
      set.rounds.push_back({1, 0, slope});
      columns.col(n) = (A.row(n) + slope * A.row(n + 1)).transpose(), columns.col(n + 1) = (A.row(n) - slope * A.row(n + 1)).transpose();
    }
    Vector b = Vector::NullaryExpr(modes, [&] { return uniform(-1, 1); });
    if (trial % 3 == 0 && rows > 0) b = columns * Vector::NullaryExpr(rows, [&] { return uniform(0, 1) < 0.5 ? 0.0 : uniform(0, 0.3); });  // at edges, often
    const SparseRows sparse = A.sparseView();
    const auto found = algebra::cone_least_squares(sparse, b, set, 1e-11);
    const auto expected = algebra::bounded_least_squares(columns, b, low, high);
    CHECK(found.converged);
    CHECK((found.residual - expected.residual).norm() <= 1e-9 * b.norm() + 1e-300);
  }
}

TEST_CASE("discs and cones in space: the residual is normal to the set at x") {
  std::mt19937 engine(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const int modes = 6, points = 1 + trial % 4;
    ConvexSet set;
    int rows = 0;
    for (int k = 0; k < points; ++k) {
      set.rounds.push_back(trial % 2 ? ConvexSet::Round{2, 0, uniform(0.1, 1)} : ConvexSet::Round{2, uniform(0.1, 1), 0});
      rows += set.rounds.back().variables();
    }
    const DenseMatrix A = DenseMatrix::NullaryExpr(rows, modes, [&] { return uniform(-1, 1); });
    const Vector b = Vector::NullaryExpr(modes, [&] { return uniform(-2, 2); });
    const auto found = algebra::cone_least_squares(SparseRows(A.sparseView()), b, set, 1e-10);
    CHECK(found.converged);
    CHECK((b - A.transpose() * found.x - found.residual).norm() <= 1e-5 * b.norm());  // rounding of x, by s
    // The most that forces in the set can do on the motion is what x does.
    const Vector moved = A * found.residual;
    double most = 0;
    int first = 0;
    for (const auto& round : set.rounds) {
      const Vector own = moved.segment(first, round.variables());
      if (round.slope > 0) CHECK(own[0] + round.slope * own.tail(2).norm() <= 1e-8 * b.norm());
      else most += round.radius * own.norm();
      first += round.variables();
    }
    CHECK(std::abs(most - found.x.dot(moved)) <= 1e-8 * b.squaredNorm());
  }
}

TEST_CASE("a tower of a thousand bodies takes a few factorisations") {
  for (const bool friction : {false, true}) {
    CAPTURE(friction);
    constexpr int bodies = 1000;
    const SparseRows A = tower(bodies, friction);
    const ConvexSet set = held_by(3 * bodies, friction ? 0.5 : 0);
    Vector weight = Vector::Zero(3 * bodies);
    for (int b = 0; b < bodies; ++b) weight[3 * b + 1] = -1;
    const auto rests = algebra::cone_least_squares(A, weight, set, 1e-10);
    CHECK(rests.converged);
    CHECK(rests.residual.norm() <= 1e-10 * weight.norm());
    CHECK(rests.steps <= 20);
    weight[3 * bodies - 2] = 1;  // the uppermost is lifted
    const auto lifted = algebra::cone_least_squares(A, weight, set, 1e-10);
    CHECK(lifted.converged);
    CHECK((lifted.residual - Vector::Unit(3 * bodies, 3 * bodies - 2)).norm() <= 1e-9);
    CHECK(lifted.steps <= 40);
  }
}

TEST_CASE("a tower that is pressed from above takes next to none: what balances its load without limits is within them") {
  for (const bool friction : {false, true}) {
    CAPTURE(friction);
    constexpr int bodies = 5000;
    const SparseRows A = tower(bodies, friction);
    const ConvexSet set = held_by(3 * bodies, friction ? 0.3 : 0);
    Vector load = Vector::Zero(3 * bodies);
    for (int b = 0; b < bodies; ++b) load[3 * b + 1] = -0.01;
    load[3 * bodies - 2] -= 1;
    const auto rests = algebra::cone_least_squares(A, load, set, 1e-10);
    CHECK(rests.converged);
    CHECK((load - A.transpose() * rests.x).norm() <= 1e-10 * load.norm());
    CHECK(rests.steps <= 10);
  }
}

TEST_CASE("it ends when it is asked to stop") {
  Stopped monitor;
  const algebra::StopFactoring stop(monitor);
  const SparseRows A = tower(3, false);
  CHECK_THROWS_AS(algebra::cone_least_squares(A, Vector::Ones(9), {std::vector<double>(9, 0), std::vector<double>(9, kInfinity), {}}), Interrupted);
}
