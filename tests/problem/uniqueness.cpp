#include "problem/uniqueness.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/stop_factoring.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

constexpr int kPoints = 40;

/// Points with a normal row and `components` tangential ones each, and nothing else: what the factor looks at.
problem::Problem points(int components, double mu) {
  problem::Problem p;
  problem::FrictionGroup group{"points", problem::coulomb(std::vector<double>(kPoints, mu)), kPoints, components, {}};
  for (int k = 0; k < kPoints; ++k) group.normal.push_back(k);
  p.friction.push_back(group);
  return p;
}

problem::CondensedProblem condensed(int components) {
  const int rows = kPoints * (1 + components);
  test::Random random(4);
  const DenseMatrix G = random.matrix(rows, rows);
  const DenseMatrix W = G * G.transpose() + rows * DenseMatrix::Identity(rows, rows);
  return {W, Vector::Zero(rows)};
}

double greatest(const DenseMatrix& A) { return algebra::eigenvalues(A).maxCoeff(); }

/// Stops at the last of so many questions.
struct StopAt final : Monitor {
  explicit StopAt(int question) : left(question) {}
  bool stop() override { return --left <= 0; }
  int left;
};

}  // namespace

TEST_CASE("the factor below which the solution is unique: its formula, from below") {
  for (const int components : {1, 2}) {
    const auto c = condensed(components);
    const DenseMatrix& W = c.W();
    const DenseMatrix normal = W.inverse().topLeftCorner(kPoints, kPoints), tangential = W.bottomRightCorner(kPoints * components, kPoints * components);
    Vector s(kPoints);
    for (int k = 0; k < kPoints; ++k) s[k] = tangential.diagonal().segment(k * components, components).mean();
    const Vector root = s.cwiseSqrt();
    Vector inverse(kPoints * components);
    for (int k = 0; k < inverse.size(); ++k) inverse[k] = 1 / root[k / components];
    const double expected = 2 / (0.3 * std::sqrt(greatest(root.asDiagonal() * normal * root.asDiagonal()) *
                                                 greatest(inverse.asDiagonal() * tangential * inverse.asDiagonal())));
    const auto factor = problem::uniqueness_factor(points(components, 0.3), c);
    REQUIRE(factor);
    CHECK(*factor <= expected);
    CHECK(*factor >= 0.99 * expected);
  }
}

TEST_CASE("the factor's computation ends at any question whether to stop; its factorisations and eigenvalues ask") {
  const auto p = points(1, 0.3);
  const auto c = condensed(1);
  constexpr int kMany = 1000;
  StopAt never(kMany);
  {
    const algebra::StopFactoring watched(never);
    CHECK(problem::uniqueness_factor(p, c));
  }
  const int questions = kMany - never.left;
  CHECK(questions >= 5);  // W's factor, the sweep with it, the product, and a proof for each eigenvalue
  for (int question = 1; question <= questions; ++question) {
    StopAt monitor(question);
    const algebra::StopFactoring watched(monitor);
    CHECK_THROWS_AS(problem::uniqueness_factor(p, c), Interrupted);
  }
}
