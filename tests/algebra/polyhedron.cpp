#include "algebra/dense/polyhedron.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/random.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("intervals, half-lines, lines, points and nothing") {
  const auto interval = algebra::polyhedron(DenseMatrix{{2}, {-1}}, Vector{{1, 3}});
  CHECK(interval.dimension(1e-9) == 1);
  CHECK(interval.bounded());
  CHECK(interval.vertices.minCoeff() == doctest::Approx(-3));
  CHECK(interval.vertices.maxCoeff() == doctest::Approx(0.5));
  const auto half = algebra::polyhedron(DenseMatrix{{-1}}, Vector{{3}});
  CHECK(half.vertices(0, 0) == doctest::Approx(-3));
  CHECK(half.rays(0, 0) == doctest::Approx(1));
  const auto line = algebra::polyhedron(DenseMatrix(0, 1), Vector(0));
  CHECK(line.lines.cols() == 1);
  CHECK(line.dimension(1e-9) == 1);
  CHECK(algebra::polyhedron(DenseMatrix{{1}, {-1}}, Vector{{2, -2}}).dimension(1e-9) == 0);
  CHECK(algebra::polyhedron(DenseMatrix{{1}, {-1}}, Vector{{2, -3}}).empty());
  CHECK(algebra::polyhedron(DenseMatrix{{0, 0}}, Vector{{-1}}).empty());
}

TEST_CASE("a cube has its 8 corners whatever the order and the repetitions of its faces; an octahedron's dual too") {
  DenseMatrix A(12, 3);
  Vector b = Vector::Ones(12);
  for (int k = 0; k < 12; ++k) A.row(k) = (k % 2 ? -1 : 1) * (1 + k / 6) * Vector::Unit(3, (k / 2) % 3).transpose();
  for (int k = 6; k < 12; ++k) b[k] = 2;
  const auto cube = algebra::polyhedron(A, b);
  CHECK(cube.vertices.cols() == 8);
  CHECK((cube.vertices.cwiseAbs().array() - 1).abs().maxCoeff() < 1e-12);
  CHECK(cube.dimension(1e-9) == 3);
  DenseMatrix O(8, 3);
  for (int k = 0; k < 8; ++k) O.row(k) << (k & 1 ? 1 : -1), (k & 2 ? 1 : -1), (k & 4 ? 1 : -1);
  CHECK(algebra::polyhedron(O, Vector::Ones(8)).vertices.cols() == 6);  // degenerate: four faces meet in each
}

TEST_CASE("vertices of random polygons are those that pairs of their sides give") {
  test::Random random(77);
  for (int trial = 0; trial < 200; ++trial) {
    const int sides = 3 + random.below(7);
    DenseMatrix A(sides, 2);
    Vector b(sides);
    for (int k = 0; k < sides; ++k) A(k, 0) = random.between(-1, 1), A(k, 1) = random.between(-1, 1), b[k] = random.between(-0.2, 1);
    const auto p = algebra::polyhedron(A, b);
    std::vector<Vector> expected;
    for (int i = 0; i < sides; ++i)
      for (int j = 0; j < i; ++j) {
        DenseMatrix both(2, 2);
        both << A.row(i), A.row(j);
        const Vector at = both.inverse() * Vector{{b[i], b[j]}};
        if ((A * at - b).maxCoeff() < 1e-9) expected.push_back(at);
      }
    CAPTURE(trial);
    REQUIRE(p.vertices.cols() == static_cast<Eigen::Index>(expected.size()));
    for (const Vector& at : expected) CHECK((p.vertices.colwise() - at).colwise().norm().minCoeff() < 1e-8 * (1 + at.norm()));
    for (Eigen::Index k = 0; k < p.rays.cols(); ++k) CHECK((A * p.rays.col(k)).maxCoeff() < 1e-8);
  }
}
