#include "problem/condensed.hpp"

#include <doctest/doctest.h>
#include <sched.h>

#include <Eigen/LU>
#include <array>

#include "../support/chain.hpp"
#include "base/error.hpp"

using namespace dotyk;
using namespace dotyk::problem;
using algebra::DenseMatrix;
using algebra::Ordering;
using algebra::Vector;
using test::Random;

namespace {

/// B between blocks: each row joins a random unknown of one to one of the other (or to the ground).
DenseMatrix random_rows(Random& random, const Problem& p, int count) {
  DenseMatrix B = DenseMatrix::Zero(count, p.unknowns());
  for (int r = 0; r < count; ++r)
    for (const Block& b : p.blocks) {
      const int node = random.below(b.size() / 2);
      B(r, b.first + 2 * node) = random.between(-1, 1);
      if (random.coin()) B(r, b.first + 2 * node + 1) = random.between(-1, 1);
    }
  return B;
}

/// Two grids of springs, the second one free, and 8 rows between them.
Problem held_and_free(Random& random, std::array<int, 2> held, std::array<int, 2> free) {
  Problem p;
  add(p, test::block("held", test::spring_grid(random, held[0], held[1], 2, 0.2), random.vector(2 * held[0] * held[1]), 2, false));
  add(p, test::block("free", test::spring_grid(random, free[0], free[1], 2, 0), random.vector(2 * free[0] * free[1]), 2, true));
  p.B = test::rows(random_rows(random, p, 8));
  p.c = random.vector(8);
  return p;
}

/// Random λ with Nᵀλ = e.
Vector balanced(Random& random, const CondensedProblem& condensed) {
  const DenseMatrix N = condensed.N();
  Vector lambda = random.vector(condensed.rows());
  return lambda + N * (N.transpose() * N).inverse() * (condensed.e() - N.transpose() * lambda);
}

/// Are forces balanced in what recover() gives, and are its gaps those of jump()?
void check_state(const Problem& p, const CondensedProblem& condensed, const Vector& lambda, const Vector& alpha) {
  const Vector u = condensed.recover(lambda, alpha);
  CHECK((stiffness_times(p, u) + p.B.transpose() * lambda - p.load()).norm() < 1e-10 * p.load().norm());
  CHECK((p.B * u - p.c - condensed.jump(lambda, alpha)).norm() < 1e-10 * u.norm());
}

}  // namespace

TEST_CASE("condensed onto its rows a held problem is B K⁻¹ Bᵀ and the free jump") {
  Random random(41);
  for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
    Problem p;
    for (const char* name : {"a", "b"})
      add(p, test::block(name, test::spring_grid(random, 5, 4, 2, 0.2), random.vector(40), 2, false));
    p.B = test::rows(random_rows(random, p, 9));
    p.c = random.vector(9);
    Clock clock;
    Monitor quiet;
    const CondensedProblem condensed(p, problem::rigid_motions(p), ordering, clock, quiet);
    const DenseMatrix K = test::stiffness(p), B = p.B, inverse = K.inverse();
    CHECK(condensed.kernel_size() == 0);
    CHECK(test::relative(condensed.W(), B * inverse * B.transpose()) < 1e-11);
    CHECK(test::relative(condensed.x0(), B * inverse * p.load() - p.c) < 1e-11);
    const Vector lambda = random.vector(9), u = inverse * (p.load() - B.transpose() * lambda);
    CHECK(test::relative(condensed.recover(lambda, Vector()), u) < 1e-11);
    CHECK(test::relative(condensed.jump(lambda, Vector()), B * u - p.c) < 1e-11);
  }
}

TEST_CASE("condensed with a kernel: any balanced multipliers and any rigid motion are in equilibrium") {
  Random random(42);
  Problem p;
  add(p, test::block("held", test::spring_grid(random, 4, 4, 2, 0.2), random.vector(32), 2, false));
  add(p, test::block("free", test::spring_grid(random, 5, 3, 2, 0), random.vector(30), 2, true));
  add(p, test::block("loose", test::spring_grid(random, 3, 3, 2, 0), random.vector(18), 2, true));
  p.B = test::rows(random_rows(random, p, 8));
  p.c = random.vector(8);
  Clock clock;
  Monitor quiet;
  const CondensedProblem condensed(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet);
  REQUIRE(condensed.kernel_size() == 4);
  CHECK(problem::rigid_motions(p).motions[0].text() == "'free': translation along x");
  CHECK(problem::rigid_motions(p).motions[3].text() == "'loose': translation along y");
  const DenseMatrix B = p.B;
  DenseMatrix R = DenseMatrix::Zero(p.unknowns(), 4);
  R.block(p.blocks[1].first, 0, 30, 2) = p.blocks[1].kernel;
  R.block(p.blocks[2].first, 2, 18, 2) = p.blocks[2].kernel;
  const Vector f = p.load();
  CHECK(test::relative(condensed.N(), B * R) < 1e-14);
  CHECK(test::relative(condensed.e(), R.transpose() * f) < 1e-14);
  const Vector lambda = balanced(random, condensed);
  check_state(p, condensed, lambda, random.vector(4));
}

namespace {

/// The rows `picked` alone.
Problem with_rows(const Problem& p, const std::vector<int>& picked) {
  Problem out = p;
  out.B = algebra::pick_rows(p.B, picked);
  out.c = p.c(picked);
  return out;
}

}  // namespace

TEST_CASE("rows taken later, twice, give what all of them give at once") {
  Random random(46);
  const std::vector<int> some{1, 2, 4, 6, 7}, more{1, 2, 4, 5, 6, 7};
  for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
    Problem p;
    for (const char* name : {"a", "b"})
      add(p, test::block(name, test::spring_grid(random, 30, 20, 2, 0.2), random.vector(1200), 2, false));
    p.B = test::rows(random_rows(random, p, 8));
    p.c = random.vector(8);
    Clock clock;
    Monitor quiet;
    const auto extend = [&](CondensedProblem& condensed, const Problem& grown, const std::vector<int>& place) {
      return condensed.extend(grown, problem::rigid_motions(grown), place, clock, quiet);
    };
    const Problem begun = with_rows(p, some);
    CondensedProblem condensed(begun, problem::rigid_motions(begun), ordering, clock, quiet);
    REQUIRE(extend(condensed, with_rows(p, more), {0, 1, 2, 4, 5}));
    REQUIRE(extend(condensed, p, {1, 2, 4, 5, 6, 7}));
    const CondensedProblem at_once(p, problem::rigid_motions(p), ordering, clock, quiet);
    const Vector lambda = random.vector(8), none;
    CHECK(condensed.W() == DenseMatrix(condensed.W().transpose()));
    CHECK(test::relative(condensed.W(), at_once.W()) < 1e-11);
    CHECK(test::relative(condensed.x0(), at_once.x0()) < 1e-11);
    CHECK(test::relative(condensed.recover(lambda, none), at_once.recover(lambda, none)) < 1e-11);
    Problem heavier = p;
    for (Block& block : heavier.blocks) block.f *= 2;
    condensed.set_load(heavier, problem::rigid_motions(heavier));
    check_state(heavier, condensed, lambda, none);
    const Vector f = random.vector(p.unknowns());
    CHECK(test::relative(condensed.response(f, none), at_once.response(f, none)) < 1e-11);
  }
}

TEST_CASE("rows taken later of free bodies: equilibrium and jumps") {
  Random random(47);
  const Problem p = held_and_free(random, {30, 20}, {25, 22});
  Clock clock;
  Monitor quiet;
  const Problem begun = with_rows(p, {0, 2, 3, 5, 6});
  CondensedProblem condensed(begun, problem::rigid_motions(begun), Ordering::automatic, clock, quiet);
  REQUIRE(condensed.extend(p, problem::rigid_motions(p), {0, 2, 3, 5, 6}, clock, quiet));
  REQUIRE(condensed.kernel_size() == 2);
  const Vector lambda = balanced(random, condensed);
  check_state(p, condensed, lambda, random.vector(2));
}

TEST_CASE("rows that would take longer to add than to factor again are not added, nor where the first felt no motion") {
  Random random(48);
  Clock clock;
  Monitor quiet;
  Problem many;
  add(many, test::block("small", test::spring_grid(random, 6, 5, 2, 0.2), random.vector(60), 2, false));
  many.B = test::rows(random_rows(random, many, 60));
  many.c = random.vector(60);
  const Problem one = with_rows(many, {3});
  CondensedProblem condensed(one, problem::rigid_motions(one), Ordering::automatic, clock, quiet);
  CHECK_FALSE(condensed.extend(many, problem::rigid_motions(many), {3}, clock, quiet));
  CHECK(condensed.rows() == 1);

  Problem unfelt;
  add(unfelt, test::block("held", test::spring_grid(random, 20, 20, 2, 0.2), random.vector(800), 2, false));
  add(unfelt, test::block("free", test::spring_grid(random, 20, 20, 2, 0), random.vector(800), 2, true));
  DenseMatrix B = DenseMatrix::Zero(2, 1600);
  B(0, 4) = B(1, 4) = 1;
  B(1, 900) = -1;
  unfelt.B = test::rows(B);
  unfelt.c = Vector::Zero(2);
  const Problem first = with_rows(unfelt, {0});
  CondensedProblem without(first, problem::rigid_motions(first), Ordering::automatic, clock, quiet);
  CHECK_FALSE(without.extend(unfelt, problem::rigid_motions(unfelt), {0}, clock, quiet));
}

TEST_CASE("a free body's rows that are far from the first ones beside their size are not added") {
  // A row of nodes with an unknown each, whose rigid motions are a translation and a slope.
  Random random(49);
  constexpr int n = 400;
  algebra::Triplets entries;
  DenseMatrix R(n, 2);
  for (int i = 0; i < n; ++i) R.row(i) << 1, i / double(n);
  for (int i = 1; i + 1 < n; ++i) {  // (u_{i−1} − 2u_i + u_{i+1})², for many i
    const double second[] = {1, -2, 1}, k = random.between(1, 2);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) entries.emplace_back(i - 1 + a, i - 1 + b, k * second[a] * second[b]);
  }
  Problem p;
  Block block;
  block.name = "beam", block.K = algebra::from_triplets(n, n, entries), block.f = Vector::Zero(n), block.kernel = R;
  for (int i = 0; i < n; ++i) block.node.push_back(i);
  add(p, block);
  for (const auto& [far, added] : {std::pair{205, true}, std::pair{390, false}}) {
    DenseMatrix B = DenseMatrix::Zero(5, n);
    for (int r = 0; r < 4; ++r) B(r, 199 + r) = 1;
    B(4, far) = 1;
    Problem all = p;
    all.B = test::rows(B), all.c = Vector::Zero(5);
    const Problem begun = with_rows(all, {0, 1, 2, 3});
    const algebra::Condensation condensation(block.K, block.node, {199, 200, 201, 202}, R);
    CHECK(condensation.are_far(algebra::pick_rows(all.B, {4}), R) == !added);
    Clock clock;
    Monitor quiet;
    CondensedProblem condensed(begun, problem::rigid_motions(begun), Ordering::automatic, clock, quiet);
    if (!added) CHECK_FALSE(condensed.extend(all, problem::rigid_motions(all), {0, 1, 2, 3}, clock, quiet));
  }
}

TEST_CASE("a condenser whose problem has grown adds the rows or condenses anew") {
  Random random(50);
  Problem p;
  add(p, test::block("a", test::spring_grid(random, 30, 20, 2, 0.2), random.vector(1200), 2, false));
  p.B = test::rows(random_rows(random, p, 8));
  p.c = random.vector(8);
  Clock clock;
  Monitor quiet;
  const auto condensed = [&](Condenser& condenser, const Problem& problem) -> const CondensedProblem& {
    return condenser.condense(problem, problem::rigid_motions(problem), Ordering::automatic, clock, quiet);
  };
  Condenser condenser, other;
  condensed(condenser, with_rows(p, {1, 3, 5}));
  CHECK_THROWS_WITH_AS(condensed(condenser, p), doctest::Contains("condensed before with 1200 unknowns and 3 rows"), InputError);
  condenser.grow({1, 3, 5});
  const DenseMatrix grown = condensed(condenser, p).W();
  condensed(other, with_rows(p, {1, 3}));
  other.grow({1, 3, 5});  // of another problem than the one before
  CHECK(test::relative(grown, condensed(other, p).W()) < 1e-11);
  CHECK_THROWS_AS(condensed(condenser, with_rows(p, {1, 3, 5})), InputError);
}

TEST_CASE("a block that no row touches is solved along") {
  Random random(43);
  Problem p;
  add(p, test::block("touched", test::spring_grid(random, 3, 3, 2, 1), random.vector(18), 2, false));
  add(p, test::block("apart", test::spring_grid(random, 3, 3, 2, 1), random.vector(18), 2, false));
  DenseMatrix B = DenseMatrix::Zero(1, 36);
  B(0, 3) = 1;
  p.B = test::rows(B);
  p.c = Vector::Zero(1);
  Clock clock;
  Monitor quiet;
  const CondensedProblem condensed(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet);
  CHECK(test::relative(condensed.recover(Vector::Zero(1), Vector()), test::stiffness(p).inverse() * p.load()) <
        1e-11);
}

TEST_CASE("a block without unknowns is passed over") {
  Random random(44);
  Problem p;
  add(p, test::block("fixed", test::SpringGrid{algebra::SparseMatrix(0, 0), {}, 0}, Vector(), 2, false));
  add(p, test::block("soft", test::spring_grid(random, 3, 3, 2, 1), random.vector(18), 2, false));
  DenseMatrix B = DenseMatrix::Zero(1, 18);
  B(0, 3) = 1;
  p.B = test::rows(B);
  p.c = Vector::Zero(1);
  Clock clock;
  Monitor quiet;
  const CondensedProblem condensed(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet);
  CHECK(condensed.recover(Vector::Zero(1), Vector()).size() == 18);
}

TEST_CASE("a block that is not held is refused by name and node") {
  Random random(45);
  Problem p;
  auto block = test::block("lid", test::spring_grid(random, 3, 3, 2, 1), random.vector(18), 2, false);
  algebra::SparseMatrix lower = block.K;
  lower.coeffRef(16, 16) = -1;
  block.K = lower;
  add(p, block);
  DenseMatrix B = DenseMatrix::Zero(1, 18);
  B(0, 3) = 1;
  p.B = test::rows(B);
  p.c = Vector::Zero(1);
  Clock clock;
  Monitor quiet;
  CHECK_THROWS_WITH_AS(CondensedProblem(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet),
                       doctest::Contains("the stiffness of 'lid' is singular at node 9"), InputError);
}

TEST_CASE("bodies factored side by side give the same bits as one after another") {
  Random random(44);
  Problem p;
  for (const char* name : {"a", "b", "c"}) add(p, test::block(name, test::spring_grid(random, 100, 80, 2, 0.2), random.vector(16000), 2, false));
  p.B = test::rows(random_rows(random, p, 9));
  p.c = random.vector(9);
  const auto condensed = [&] {
    Clock clock;
    Monitor quiet;
    CondensedProblem all(p, problem::rigid_motions(p), {}, clock, quiet);
    CHECK(work_of_condensing(p).flops > 1e8);  // worth threads
    return all;
  };
  const CondensedProblem beside = condensed();
  cpu_set_t before, one;
  REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
  const CondensedProblem after = condensed();
  REQUIRE(sched_setaffinity(0, sizeof before, &before) == 0);
  const Vector lambda = random.vector(9);
  CHECK((beside.W().array() == after.W().array()).all());
  CHECK((beside.x0().array() == after.x0().array()).all());
  CHECK((beside.recover(lambda, Vector()).array() == after.recover(lambda, Vector()).array()).all());
}

TEST_CASE("another load on the same factors is what a condensation anew gives") {
  Random random(45);
  Problem p = held_and_free(random, {4, 4}, {5, 3});
  Clock clock;
  Monitor quiet;
  Condenser condenser;
  condenser.condense(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet);
  const double factored = clock.factor;
  for (Block& block : p.blocks) block.f = random.vector(block.size());
  p.c = random.vector(8);
  const RigidMotions rigid = problem::rigid_motions(p);
  const CondensedProblem& taken = condenser.condense(p, rigid, Ordering::automatic, clock, quiet);
  CHECK(clock.factor == factored);
  const CondensedProblem anew(p, rigid, Ordering::automatic, clock, quiet);
  const Vector lambda = random.vector(8), alpha = random.vector(anew.kernel_size());
  CHECK(test::relative(taken.x0(), anew.x0()) < 1e-14);
  CHECK(test::relative(taken.e(), anew.e()) < 1e-14);
  CHECK(test::relative(taken.recover(lambda, alpha), anew.recover(lambda, alpha)) < 1e-14);
  p.B = test::rows(random_rows(random, p, 7));
  p.c = random.vector(7);
  CHECK_THROWS_WITH_AS(condenser.condense(p, problem::rigid_motions(p), Ordering::automatic, clock, quiet),
                       doctest::Contains("condensed before with 62 unknowns and 8 rows"), InputError);
}
