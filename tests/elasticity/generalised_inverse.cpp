#include "algebra/dense/generalised_inverse.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "../support/elastic.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/error.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::GeneralisedInverse;
using mesh::Point;

namespace {

/// Every column less its part in the kernel.
DenseMatrix project(const GeneralisedInverse& inverse, const DenseMatrix& u) { return u - inverse.basis() * (inverse.basis().transpose() * u); }

struct Body {
  mesh::Mesh mesh;
  elasticity::Numbering numbering;
  algebra::SparseMatrix lower;
  DenseMatrix K, R;
};

Body body(mesh::Mesh m, const std::function<bool(const Point&, int)>& held) {
  Body b{std::move(m), {}, {}, {}, {}};
  b.numbering = test::prescribe(b.mesh, held, [](const Point&) { return Point{0, 0, 0}; });
  b.lower = elasticity::assemble(b.mesh, test::steel(b.mesh.dimension()), {}, b.numbering);
  b.K = test::full(b.lower);
  b.R = elasticity::rigid_modes(b.mesh, b.numbering, {}).modes;
  return b;
}

Body free_body(mesh::Mesh m) {
  return body(std::move(m), [](const Point&, int) { return false; });
}

/// Bodies whose supports leave 0, 1, 2, 3, 5 and 6 motions free.
std::vector<Body> bodies() {
  std::vector<Body> all;
  for (const auto family : test::kFamilies) {
    auto plane = test::unit(2, family, 5);
    test::distort(plane, 0.02);
    mesh::transform(plane, [](const Point& x) { return Point{1 + 2 * x[0], x[1], 0}; });
    all.push_back(free_body(plane));
    all.push_back(body(plane, [](const Point& x, int i) { return i == 0 && x[0] == 1; }));
    all.push_back(body(plane, [](const Point& x, int) { return x[0] == 1 && x[1] == 0; }));
    all.push_back(body(plane, [](const Point& x, int) { return x[0] == 1; }));
    auto space = test::unit(3, family, 3);
    test::distort(space, 0.02);
    all.push_back(free_body(space));
    all.push_back(body(space, [](const Point& x, int i) { return i == 2 && x[2] == 0; }));
    all.push_back(body(space, [](const Point& x, int) { return x[0] == 0 && x[1] == 0; }));
    all.push_back(body(space, [](const Point& x, int i) { return i == 2 && x[0] == 0 && x[1] == 0 && x[2] == 0; }));
  }
  return all;
}

GeneralisedInverse factored(const Body& b) {
  GeneralisedInverse inverse(b.lower, b.numbering.node, b.R);
  REQUIRE(inverse.factor(b.lower));
  return inverse;
}

/// Moore–Penrose inverse by eigenvalues; `modes` of them are zero.
DenseMatrix pseudo_inverse(const Body& b) {
  const algebra::Eigenpairs e = algebra::eigenpairs(b.K);
  const auto n = b.K.rows() - b.R.cols();
  return e.vectors.rightCols(n) * e.values.tail(n).cwiseInverse().asDiagonal() *
         e.vectors.rightCols(n).transpose();
}

/// Condition number of what is left of K when the unknowns are fixed.
double condition(const Body& b, const std::vector<int>& fixed) {
  std::vector<int> rest;
  for (int k = 0; k < b.K.rows(); ++k)
    if (std::find(fixed.begin(), fixed.end(), k) == fixed.end()) rest.push_back(k);
  const algebra::Vector e = algebra::eigenvalues(b.K(rest, rest));
  return e.maxCoeff() / std::abs(e.minCoeff());
}

double least_singular(const Body& b, const std::vector<int>& fixed) {
  const DenseMatrix Q = algebra::orthonormal(b.R);
  return algebra::smallest_singular_value(Q(fixed, Eigen::all));
}

}  // namespace

TEST_CASE("a generalised inverse by fixed unknowns: K K⁺ K = K, K⁺ K K⁺ = K⁺, symmetric, K† when projected") {
  std::vector<int> kernels;
  for (const Body& b : bodies()) {
    const int n = static_cast<int>(b.K.rows());
    kernels.push_back(static_cast<int>(b.R.cols()));
    CAPTURE(n);
    CAPTURE(b.R.cols());
    const GeneralisedInverse inverse = factored(b);
    const DenseMatrix X = inverse.apply(DenseMatrix::Identity(n, n));
    CHECK(test::relative(b.K * X * b.K, b.K) < 1e-12);
    CHECK(test::relative(b.K * inverse.apply(b.K), b.K) < 1e-12);
    CHECK(test::relative(X * b.K * X, X) < 1e-11);  // of the size of X's own error, ε κ(K_JJ)
    CHECK((X - X.transpose()).norm() < 1e-12 * X.norm());
    for (int unknown : inverse.fixed()) CHECK(X.row(unknown).norm() == 0);
    CHECK(test::relative(project(inverse, project(inverse, X).transpose()), pseudo_inverse(b)) < 1e-10);
    // The bound on the norm by the regularity of the choice.
    const auto norm = [](const DenseMatrix& a) { return algebra::singular_values(a)[0]; };
    CHECK(norm(X) <= (1 + 1e-9) * norm(pseudo_inverse(b)) / std::pow(inverse.regularity(), 2));
  }
  CHECK(kernels == std::vector<int>{3, 1, 1, 0, 6, 3, 1, 5, 3, 1, 1, 0, 6, 3, 1, 5});
}

TEST_CASE("loads in equilibrium are balanced; of others the fixed unknowns take the rest") {
  test::Random random(77);
  for (const Body& b : bodies()) {
    const GeneralisedInverse inverse = factored(b);
    const int n = static_cast<int>(b.K.rows());
    const DenseMatrix f = random.matrix(n, 7), balanced = project(inverse, f);
    CHECK(test::relative(b.K * inverse.apply(balanced), balanced) < 1e-12);
    CHECK((project(inverse, inverse.apply(balanced)).transpose() * b.R).norm() < 1e-11 * inverse.apply(balanced).norm());
    DenseMatrix missing = b.K * inverse.apply(f) - f;
    if (b.R.cols() > 0) CHECK(missing.norm() > 1e-3);
    missing(inverse.fixed(), Eigen::all).setZero();
    CHECK(missing.norm() < 1e-12 * f.norm());
  }
}

TEST_CASE("the unknowns fixed: far apart, not in a line, whatever the basis of the kernel") {
  test::Random random(78);
  for (const auto family : test::kFamilies) {
    const Body b = free_body(test::unit(3, family, 4));
    const std::vector<int> fixed = algebra::fixing_unknowns(b.R);
    std::vector<Point> nodes;
    for (int unknown : fixed) {
      const Point x = b.mesh.point(b.numbering.node[unknown]);
      if (std::find(nodes.begin(), nodes.end(), x) == nodes.end()) nodes.push_back(x);
    }
    REQUIRE(nodes.size() >= 3);
    double most = 0, area = 0;
    for (const Point& p : nodes)
      for (const Point& q : nodes)
        for (const Point& r : nodes) {
          const Eigen::Vector3d u(q[0] - p[0], q[1] - p[1], q[2] - p[2]), v(r[0] - p[0], r[1] - p[1], r[2] - p[2]);
          most = std::max(most, u.norm());
          area = std::max(area, u.cross(v).norm() / 2);
        }
    CHECK(most > 1.4);  // at least a face's diagonal of the unit cube
    CHECK(area > 0.5);  // of the triangle that holds the rotations
    const DenseMatrix other = b.R * random.positive_definite(6, 0.5);
    CHECK(least_singular(b, algebra::fixing_unknowns(other)) == doctest::Approx(least_singular(b, fixed)).epsilon(0.2));
  }
}

TEST_CASE("the choice against nodes close together and against random ones: condition numbers") {
  test::Random random(79);
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const Body b = free_body(test::unit(dim, family, dim == 2 ? 10 : 4));
      const std::vector<int> chosen = algebra::fixing_unknowns(b.R);
      const int nodes = dim == 2 ? 11 : 5;  // along an edge
      // Neighbours in the corner: (u, v) of one and v of the next; in space all of one, two and one of its neighbours.
      const std::vector<int> close = dim == 2 ? std::vector<int>{0, 1, 3}
                                              : std::vector<int>{0, 1, 2, 4, 5, 3 * nodes + 2};
      const double good = condition(b, chosen), bad = condition(b, close);
      MESSAGE(dim, "-D, ", family == mesh::Family::p1 ? "P1" : "Q1", ": condition ", good, " as chosen, ", bad,
              " with neighbours fixed; regularity ", least_singular(b, chosen), " and ", least_singular(b, close));
      CHECK(good < (dim == 2 ? 0.05 : 0.2) * bad);
      CHECK(least_singular(b, chosen) > 5 * least_singular(b, close));
      // What the choice promises: no exchange helps by more than a tenth, and from that a bound.
      const double d = static_cast<double>(b.R.cols()), n = static_cast<double>(b.R.rows());
      const DenseMatrix held = b.R(chosen, Eigen::all);
      CHECK((b.R * held.inverse()).cwiseAbs().maxCoeff() < 1.1 + 1e-9);
      CHECK(least_singular(b, chosen) >= 1 / std::sqrt(1 + 1.21 * d * (n - d)));
      double best = INFINITY;
      for (int trial = 0; trial < 10; ++trial) {
        std::vector<int> guess;
        while (guess.size() < chosen.size()) {
          const int u = random.below(static_cast<int>(b.K.rows()));
          if (std::find(guess.begin(), guess.end(), u) == guess.end()) guess.push_back(u);
        }
        best = std::min(best, condition(b, guess));
      }
      MESSAGE("  best of random choices: condition ", best);
      CHECK(good < 10 * best);  // it looks at the kernel alone, not at the stiffness: near the best, not best
    }
}

TEST_CASE("what cannot be a generalised inverse is refused") {
  const Body b = free_body(test::unit(2, mesh::Family::q1, 2));
  CHECK_THROWS_WITH_AS(GeneralisedInverse(b.lower, b.numbering.node, b.R, {0, 1}),
                       doctest::Contains("2 unknowns are fixed; the kernel has 3 motions"), InputError);
  CHECK_THROWS_WITH_AS(GeneralisedInverse(b.lower, b.numbering.node, b.R, {0, 2, 4}),  // only x of three nodes
                       doctest::Contains("do not hold every motion"), InputError);
  // A kernel that is more than what was named: no rotation.
  GeneralisedInverse incomplete(b.lower, b.numbering.node, b.R.leftCols(2));
  if (incomplete.factor(b.lower))  // rounding may let the last pivot pass as tiny: huge, never wrong by a little
    CHECK(incomplete.apply(algebra::Vector::Ones(b.K.rows())).norm() > 1e10);
}
