#include "algebra/direct/cholesky.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <numeric>

#include "../support/spring_grid.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/parallel.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using namespace dotyk::algebra;
using dotyk::test::Random;

namespace {

constexpr Ordering kOrderings[] = {Ordering::automatic, Ordering::minimum_degree, Ordering::nested_dissection};
// Rounding of matrices of some hundred unknowns and condition below 1e4.
constexpr double kRounding = 1e-11;

}  // namespace

TEST_CASE("Cholesky solves as the dense factorisation does") {
  Random random(1);
  for (int per_node : {1, 2, 3})
    for (const Ordering ordering : kOrderings)
      for (const bool uneven : {false, true}) {
        if (per_node == 1 && uneven) continue;
        const auto grid = test::spring_grid(random, 9, 7, per_node, 0.3, uneven);
        Cholesky cholesky(grid.K, grid.node, {}, ordering);
        REQUIRE(cholesky.factor(grid.K));
        CHECK(cholesky.failed_unknown() == -1);
        const DenseMatrix b = random.matrix(static_cast<int>(grid.node.size()), 3);
        CHECK(test::relative(cholesky.solve(b), algebra::Ldlt(test::full(grid.K)).solve(b)) < kRounding);
        CHECK(cholesky.flops() > 0);
        CHECK(cholesky.bytes() >= 8.0 * static_cast<double>(grid.node.size()));
      }
}

TEST_CASE("a sweep of sparse rows is zero where they do not reach, and elsewhere as the sweep of columns") {
  Random random(2);
  for (const Ordering ordering : kOrderings) {
    const auto grid = test::spring_grid(random, 30, 20, 2, 0.3);
    const int n = static_cast<int>(grid.node.size());
    Cholesky cholesky(grid.K, grid.node, {0, 1, 2, 31, 32}, ordering);
    REQUIRE(cholesky.factor(grid.K));
    Triplets entries;
    for (int r = 0; r < 4; ++r)
      for (int k = 0; k < 3; ++k) entries.emplace_back(r, random.below(60), random.between(-1, 1));
    const SparseRows rows = from_triplets<SparseRows>(4, n, entries);
    const ReachedSweep sweep = cholesky.sweep(rows);
    const DenseMatrix found = sweep.values();
    CHECK(static_cast<int>(sweep.positions().size()) < n);
    CHECK(sweep.flops() > 0);
    for (int r = 0; r < 4; ++r) {
      const Vector whole = cholesky.forward(Vector(DenseMatrix(rows).row(r)));
      Vector spread = Vector::Zero(n);
      spread(sweep.positions()) = found.col(r);
      CHECK(test::relative(spread, whole) < kRounding);
      CHECK(test::relative(cholesky.boundary_part(sweep, found).col(r), cholesky.boundary_part(whole)) < kRounding);
    }
  }
}

TEST_CASE("a factorisation ends early where its watcher asks to stop, and is whole again afterwards") {
  struct Patience : Monitor {
    explicit Patience(int n) : left(n) {}
    bool stop() override { return --left < 0; }
    int left;
  };
  const SparseMatrix K = test::laplacian(12, 12, 12);
  std::vector<int> node(K.rows());
  std::iota(node.begin(), node.end(), 0);
  const Vector b = Random(3).vector(static_cast<int>(K.rows()));
  Cholesky cholesky(K, node, {});
  Patience endless(1 << 30);
  {
    const StopFactoring stop(endless);
    REQUIRE(cholesky.factor(K));
  }
  const int asked = (1 << 30) - endless.left;
  CHECK(asked > 10);
  const DenseMatrix x = cholesky.solve(b);
  CHECK(test::relative(test::full(K) * x, b) < kRounding);
  for (const int after : {0, 1, asked / 2, asked - 1}) {
    Patience patience(after);
    {
      const StopFactoring stop(patience);
      CHECK_THROWS_AS(cholesky.factor(K), Interrupted);
    }
    CHECK(cholesky.factor(K));
    CHECK(cholesky.solve(b) == x);
  }
}

TEST_CASE("a dense matrix of one node and a diagonal one are factored too") {
  Random random(2);
  const DenseMatrix dense = random.positive_definite(30, 1),
                    diagonal = random.vector(30).cwiseAbs().array().matrix().asDiagonal();
  std::vector<int> own(30);
  std::iota(own.begin(), own.end(), 0);
  for (const Ordering ordering : kOrderings)
    for (const auto& node : {std::vector<int>(30, 0), own}) {
      const Vector b = random.vector(30);
      Cholesky one(test::lower(dense), node, {}, ordering);
      REQUIRE(one.factor(test::lower(dense)));
      CHECK(test::relative(one.solve(b), algebra::Ldlt(dense).solve(b)) < kRounding);
    }
  for (const Ordering ordering : kOrderings) {
    Cholesky cholesky(test::lower(diagonal), own, {4, 7}, ordering);
    REQUIRE(cholesky.factor(test::lower(diagonal)));
    CHECK(cholesky.boundary_factor().rows() == 2);
    CHECK(test::relative(cholesky.solve(Vector::Ones(30)), diagonal.diagonal().cwiseInverse()) < kRounding);
  }
}

TEST_CASE("the trailing block of the factor is the Schur complement's factor") {
  Random random(3);
  for (int per_node : {1, 2, 3})
    for (const Ordering ordering : kOrderings) {
      const auto grid = test::spring_grid(random, 8, 8, per_node, 0.2, per_node > 1);
      const DenseMatrix A = test::full(grid.K);
      std::vector<int> side(8), all(64), scattered;
      std::iota(side.begin(), side.end(), 0);
      std::iota(all.begin(), all.end(), 0);
      for (int n = 0; n < 64; ++n)
        if (random.below(4) == 0) scattered.push_back(n);
      std::reverse(scattered.begin(), scattered.end());
      for (const auto& last : {side, {27}, {63, 0}, all, scattered}) {
        Cholesky cholesky(grid.K, grid.node, last, ordering);
        REQUIRE(cholesky.factor(grid.K));
        const DenseMatrix L = cholesky.boundary_factor();
        REQUIRE(L.rows() == static_cast<int>(cholesky.boundary().size()));
        for (int u : cholesky.boundary()) CHECK(std::find(last.begin(), last.end(), grid.node[u]) != last.end());
        CHECK(L.isLowerTriangular(0));
        CHECK(test::relative(L * L.transpose(), test::schur(A, cholesky.boundary())) < kRounding);
        // Sweeps with an untouched boundary part are a solve.
        const Vector b = random.vector(static_cast<int>(A.rows()));
        CHECK(test::relative(cholesky.backward(cholesky.forward(b)), algebra::Ldlt(A).solve(b)) < kRounding);
      }
    }
}

TEST_CASE("sweeps around given boundary values solve the inner problem") {
  Random random(4);
  const auto grid = test::spring_grid(random, 7, 5, 2, 0.2);
  const DenseMatrix A = test::full(grid.K);
  Cholesky cholesky(grid.K, grid.node, {0, 1, 2, 34}, Ordering::automatic);
  REQUIRE(cholesky.factor(grid.K));
  const Vector b = random.vector(static_cast<int>(A.rows())), given = random.vector(8);
  Vector swept = cholesky.forward(b);
  cholesky.set_boundary_part(swept, cholesky.boundary_factor().transpose() * given);
  const Vector x = cholesky.backward(swept);
  Vector residual = A * x - b;
  for (int k = 0; k < 8; ++k) {
    CHECK(std::abs(x[cholesky.boundary()[k]] - given[k]) < kRounding);
    residual[cholesky.boundary()[k]] = 0;
  }
  CHECK(residual.norm() < kRounding * b.norm());
}

TEST_CASE("the same analysis factors another matrix of the pattern") {
  Random random(5);
  const auto grid = test::spring_grid(random, 6, 6, 2, 1);
  Cholesky cholesky(grid.K, grid.node, {0});
  REQUIRE(cholesky.factor(grid.K));
  const SparseMatrix twice = 2 * grid.K;
  REQUIRE(cholesky.factor(twice));
  const Vector b = random.vector(72);
  CHECK(test::relative(cholesky.solve(b), algebra::Ldlt(2 * test::full(grid.K)).solve(b)) < kRounding);
}

TEST_CASE("a matrix that is not positive definite is reported with an unknown, and the next one factors") {
  Random random(6);
  for (const Ordering ordering : kOrderings) {
    const auto grid = test::spring_grid(random, 6, 6, 2, 1);
    Cholesky cholesky(grid.K, grid.node, {3, 4}, ordering);
    SparseMatrix indefinite = grid.K;
    indefinite.coeffRef(17, 17) = -1;
    CHECK_FALSE(cholesky.factor(indefinite));
    CHECK(cholesky.failed_unknown() >= 0);
    CHECK(cholesky.failed_unknown() < 72);
    SparseMatrix zero = grid.K;
    zero *= 0;
    CHECK_FALSE(cholesky.factor(zero));
    CHECK(cholesky.factor(grid.K));
    CHECK(cholesky.failed_unknown() == -1);
  }
}

TEST_CASE("a matrix without unknowns") {
  const SparseMatrix none(0, 0);
  for (const Ordering ordering : kOrderings) {
    Cholesky cholesky(none, {}, {}, ordering);
    CHECK(cholesky.factor(none));
    CHECK(cholesky.solve(Vector()).size() == 0);
    CHECK(cholesky.boundary().empty());
    CHECK(cholesky.boundary_factor().size() == 0);
  }
}

TEST_CASE("small matrices of every size, with random holes and last nodes") {
  Random random(8);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 10;
    DenseMatrix A = random.positive_definite(n, 1);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j)
        if (random.coin()) A(i, j) = A(j, i) = 0;
    A.diagonal().array() += n;  // definite again
    std::vector<int> node(n), last;
    std::iota(node.begin(), node.end(), 0);
    for (int i = 0; i < n; ++i)
      if (random.coin()) last.push_back(i);
    Cholesky cholesky(test::lower(A), node, last, kOrderings[trial % 3]);
    REQUIRE(cholesky.factor(test::lower(A)));
    const Vector b = random.vector(n);
    CHECK(test::relative(cholesky.solve(b), algebra::Ldlt(A).solve(b)) < kRounding);
    const DenseMatrix L = cholesky.boundary_factor();
    if (!last.empty()) CHECK(test::relative(L * L.transpose(), test::schur(A, cholesky.boundary())) < kRounding);
  }
}

TEST_CASE("nodes of the last set that carry no unknowns are passed over") {
  Random random(7);
  auto grid = test::spring_grid(random, 4, 4, 2, 1);
  for (int& n : grid.node) n = 2 * n + 1;  // even nodes have none
  Cholesky cholesky(grid.K, grid.node, {0, 3, 200}, Ordering::automatic);
  REQUIRE(cholesky.factor(grid.K));
  CHECK(cholesky.boundary().size() == 2);
}

TEST_CASE("a factor is swept by several threads at once") {
  Random random(61);
  const auto grid = test::spring_grid(random, 20, 20, 2, 0.3);
  Cholesky cholesky(grid.K, grid.node, {});
  REQUIRE(cholesky.factor(grid.K));
  std::vector<DenseMatrix> b, x(40);
  for (int k = 0; k < 40; ++k) b.push_back(random.matrix(800, 1 + k % 9));
  parallel_for(40, [&](int k) { x[k] = cholesky.solve(b[k]); });
  for (int k = 0; k < 40; ++k) CHECK(x[k] == cholesky.solve(b[k]));
}

TEST_CASE("the pivots multiply to the determinant; that of an unknown eliminated last is its Schur complement") {
  Random random(62);
  const auto grid = test::spring_grid(random, 5, 4, 1, 0.3);
  Cholesky cholesky(grid.K, grid.node, {7});
  REQUIRE(cholesky.factor(grid.K));
  const Vector pivots = cholesky.pivots();
  CHECK(pivots.prod() == doctest::Approx(test::full(grid.K).determinant()).epsilon(1e-10));
  CHECK(pivots[7] == doctest::Approx(test::schur(test::full(grid.K), {7})(0, 0)).epsilon(1e-10));
}
