#include "algebra/direct/condensation.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/spring_grid.hpp"
#include "algebra/dense/decompositions.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using namespace dotyk::algebra;
using dotyk::test::Random;

namespace {

/// Translations of all nodes.
DenseMatrix translations(int unknowns, int per_node) {
  DenseMatrix R = DenseMatrix::Zero(unknowns, per_node);
  for (int u = 0; u < unknowns; ++u) R(u, u % per_node) = 1;
  return R;
}

DenseMatrix solve_columns(const Condensation& c, const DenseMatrix& b) {
  DenseMatrix x(b.rows(), b.cols());
  for (int j = 0; j < b.cols(); ++j) x.col(j) = c.solve(b.col(j));
  return x;
}

}  // namespace

TEST_CASE("condensation of a held body: S⁻¹, condensed load, recovery, half compliance") {
  Random random(11);
  for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
    const auto grid = test::spring_grid(random, 7, 6, 2, 0.1, true);
    const int n = static_cast<int>(grid.node.size());
    const DenseMatrix K = test::full(grid.K);
    Condensation c(grid.K, grid.node, {0, 1, 2, 3, 40}, DenseMatrix(n, 0), ordering);
    REQUIRE(c.factor(grid.K));
    const int m = static_cast<int>(c.boundary().size());
    const DenseMatrix S = test::schur(K, c.boundary());
    CHECK(test::relative(solve_columns(c, DenseMatrix::Identity(m, m)), S.inverse()) < 1e-11);

    const Vector f = random.vector(n);
    const Vector u = algebra::Ldlt(K).solve(f), condensed = c.condense(f);
    CHECK(test::relative(S * u(c.boundary()), condensed) < 1e-11);
    CHECK(test::relative(c.recover(u(c.boundary())), u) < 1e-11);

    SparseRows B = DenseMatrix(random.matrix(5, m)).sparseView();
    const DenseMatrix half = c.half_compliance(B);
    CHECK(test::relative(half.transpose() * half, DenseMatrix(B) * S.inverse() * DenseMatrix(B).transpose()) < 1e-11);
  }
}

TEST_CASE("condensation of a free body: M⁻¹ is a generalised inverse of S") {
  Random random(12);
  for (int per_node : {1, 2, 3}) {
    const auto grid = test::spring_grid(random, 8, 5, per_node, 0);
    const int n = static_cast<int>(grid.node.size());
    const DenseMatrix K = test::full(grid.K), R = translations(n, per_node);
    REQUIRE((K * R).norm() < 1e-12 * K.norm());
    for (const std::vector<int>& last : {std::vector<int>{0, 1, 2}, {39}, {0, 7, 32, 39, 20}}) {
      Condensation c(grid.K, grid.node, last, R);
      REQUIRE(c.factor(grid.K));
      CHECK(c.kernel_size() == per_node);
      const DenseMatrix S = test::schur(K, c.boundary());
      if (last.size() > 1)  // on one node S is zero
        CHECK((S * solve_columns(c, S) - S).norm() < 1e-9 * S.norm());
      // Any balanced load: u_Γ from M⁻¹ and the recovery balance it, whatever rigid motion is added.
      Vector f = random.vector(n);
      f -= R * (R.transpose() * R).inverse() * R.transpose() * f;
      const Vector amount = random.vector(per_node);
      const Vector boundary = c.solve(c.condense(f)) + c.boundary_kernel() * amount;
      const Vector u = c.recover(boundary);
      CHECK((K * u - f).norm() < 1e-9 * f.norm());
      CHECK((u(c.boundary()) - boundary).norm() < 1e-11 * boundary.norm());
    }
  }
}

TEST_CASE("unknowns far from a small part hold what turns about it, and feel nothing that the part does not") {
  constexpr int n = 200;  // points along a line, with two unknowns
  DenseMatrix R = DenseMatrix::Zero(2 * n, 3);
  for (int i = 0; i < n; ++i) R(2 * i, 0) = R(2 * i + 1, 1) = 1, R(2 * i + 1, 2) = i / double(n);  // along, across, a rotation
  const auto across = [](std::vector<int> points) {
    for (int& i : points) i = 2 * i + 1;
    return points;
  };
  CHECK(algebra::far_unknowns(R, across({0, 50, 100, 199})).empty());
  CHECK(algebra::far_unknowns(R, across({7})).empty());  // feels no rotation
  std::vector<int> part = across({99, 100, 101}), far = algebra::far_unknowns(R, part);
  REQUIRE(far.size() == 2);
  for (const int unknown : far) CHECK(unknown % 2 == 1);
  CHECK(std::abs(far[0] - far[1]) > n);
  part.insert(part.end(), far.begin(), far.end());
  CHECK(algebra::far_unknowns(R, part).empty());
  CHECK(algebra::far_unknowns(R, {}).empty());
}

TEST_CASE("unknowns far from a small part of a turned body: none of the part's own, and all motions are then near") {
  Random random(17);
  constexpr int n = 60;  // nodes in space, all directions mixed
  DenseMatrix R(3 * n, 6);
  for (int i = 0; i < n; ++i) {
    const double x = i ? random.between(-1, 1) : 2, y = i ? random.between(-1, 1) : 2, z = i ? random.between(-1, 1) : 2;  // the part lies outermost
    R.middleRows(3 * i, 3) << 1, 0, 0, 0, z, -y, 0, 1, 0, -z, 0, x, 0, 0, 1, y, -x, 0;
  }
  R.middleRows(3, 6) = R.topRows(3).replicate(2, 1);  // nodes 1 and 2 are near node 0
  R.middleRows(3, 6).rightCols(3) += 1e-3 * random.matrix(6, 3);
  const auto all_of = [](int nodes) {
    std::vector<int> unknowns(static_cast<std::size_t>(3 * nodes));
    std::iota(unknowns.begin(), unknowns.end(), 0);
    return unknowns;
  };
  std::vector<int> part = all_of(3), far = algebra::far_unknowns(R, part);
  CHECK(!far.empty());
  for (const int unknown : far) CHECK(unknown >= 9);
  part.insert(part.end(), far.begin(), far.end());
  CHECK(algebra::far_unknowns(R, part).empty());
  CHECK(algebra::far_unknowns(R, all_of(n)).empty());
}

TEST_CASE("condensation reports a body that its boundary and kernel do not hold") {
  Random random(13);
  const auto grid = test::spring_grid(random, 5, 5, 2, 0);
  Condensation unsaid(grid.K, grid.node, {0, 1}, DenseMatrix(50, 0));  // a kernel that nobody named
  // Rounding may let the last pivot pass as tiny: then the compliance is huge, never wrong by a little.
  if (unsaid.factor(grid.K)) CHECK(unsaid.solve(Vector::Ones(4)).norm() > 1e10);
  // A mechanism off Γ: node 24 tied to nothing.
  DenseMatrix K = test::full(grid.K);
  K.row(48).setZero(), K.col(48).setZero();
  Condensation loose(test::lower(K), grid.node, {0, 1}, translations(50, 2));
  CHECK_FALSE(loose.factor(test::lower(K)));
  CHECK(loose.failed_unknown() == 48);
}

TEST_CASE("condensation onto nothing is a plain solve") {
  Random random(14);
  const auto grid = test::spring_grid(random, 5, 5, 2, 1);
  Condensation c(grid.K, grid.node, {}, DenseMatrix(50, 0));
  REQUIRE(c.factor(grid.K));
  const Vector f = random.vector(50);
  CHECK(c.condense(f).size() == 0);
  CHECK(test::relative(c.recover(Vector()), algebra::Ldlt(test::full(grid.K)).solve(f)) < 1e-11);
  CHECK(c.half_compliance(SparseRows(0, 0)).size() == 0);
}
