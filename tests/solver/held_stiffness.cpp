#include <doctest/doctest.h>

#include <cmath>

#include "../multigrid/built.hpp"
#include "../multigrid/elastic_cube.hpp"
#include "../support/programs.hpp"
#include "algebra/congruent.hpp"
#include "multigrid/slices.hpp"
#include "problem/coarser.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/active/held_stiffness.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

struct Displaced {
  Vector u, resistance;  ///< the latter as an iterative solver tells it, in the basis where rows are unknowns
};

/// By the forces b in that basis.
Displaced displaced(const solver::HeldStiffness& stiffness, const Vector& b, double tolerance = solver::HeldStiffness::kTolerance) {
  algebra::Field forces = stiffness.field();
  forces.put(b);
  const auto by = stiffness.solve_in_basis(forces, forces.watched(), tolerance);
  REQUIRE(by.found);
  CHECK(by.u.watched() == by.near_u);
  if (!by.told) return {by.u.get(), {}};
  forces.add(-1, by.left), forces.set_watched(by.near_resistance);
  return {by.u.get(), forces.get()};
}

}  // namespace

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
      const auto by = displaced(stiffness, random.vector(kUnknowns), 1e-14);
      REQUIRE(by.resistance.size() == kUnknowns);
      CHECK((by.resistance - product(by.u)).norm() <= 1e-12 * product(by.u).norm());
      CHECK((stiffness.resistance_of_watched(at_held(stiffness.near_rows())) - product(T * at_held)(stiffness.near_rows())).norm() <= 1e-12 * product(T * at_held).norm() + 1e-13);
    }
  }
}

TEST_CASE("a free body may be held far from its rows: where fixing_noticed() says") {
  constexpr int kUnknowns = 30;
  test::Random random(84);
  Monitor quiet;
  // A chain of springs, which moves freely by 1 + i at its unknown i, most at the end that is far from the row.
  DenseMatrix K = DenseMatrix::Zero(kUnknowns, kUnknowns);
  const auto of = [](int i) { return 1.0 / (1 + i); };
  for (int i = 0; i + 1 < kUnknowns; ++i) {
    Vector stretch = Vector::Zero(kUnknowns);
    stretch[i] = -of(i), stretch[i + 1] = of(i + 1);
    K += random.between(1, 2) * stretch * stretch.transpose();
  }
  DenseMatrix B = DenseMatrix::Zero(1, kUnknowns);
  B(0, 0) = 1;
  auto p = test::program(K, random.vector(kUnknowns), B, Vector::Zero(1));
  p.groups = {test::group(problem::unilateral(), 0, 1)};
  p.blocks[0].kernel = Vector::LinSpaced(kUnknowns, 1, kUnknowns);
  solver::HeldStiffness stiffness(p, problem::rigid_motions(p), solver::incomplete_factor(), quiet);
  REQUIRE(stiffness.fixing_noticed() == std::vector{kUnknowns - 1});
  std::vector<char> held(kUnknowns, 0);
  held.back() = 1;
  REQUIRE(stiffness.factor(Vector::Zero(1), held));
  Vector b = random.vector(kUnknowns);
  const auto by = displaced(stiffness, b, 1e-14);
  CHECK(by.u[kUnknowns - 1] == 0);
  Vector expected = Vector::Zero(kUnknowns);
  expected.head(kUnknowns - 1) = K.topLeftCorner(kUnknowns - 1, kUnknowns - 1).ldlt().solve(b.head(kUnknowns - 1));
  CHECK((by.u - expected).norm() <= 1e-9 * expected.norm());  // the condition, below 1e5, times the tolerance
  CHECK((by.resistance - K * by.u).norm() <= 1e-11 * b.norm());
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
    const auto by = displaced(iterated, b, 1e-14);
    const Vector u = displaced(factored, b).u, resistance = iterated.basis().forces(problem::stiffness_times(p, u));
    CHECK((by.u - u).norm() <= 1e-11 * u.norm());  // the condition, below 1000, times the tolerance
    REQUIRE(by.resistance.size() == kUnknowns);
    CHECK((by.resistance - resistance).norm() <= 1e-11 * resistance.norm());
  }
}

namespace {

/// A matrix as lists, and back: what ranks assemble, here all of it.
Lists as_lists(const algebra::SparseMatrix& lower) {
  Lists lists{{{static_cast<int>(lower.rows())}, {}, {}}, {{}}};
  for (const auto& entry : test::entries(lower)) lists.whole[1].push_back(entry.row()), lists.whole[2].push_back(entry.col()), lists.real[0].push_back(entry.value());
  return lists;
}
algebra::StoredMatrix from_lists(Lists lists) {
  algebra::Triplets entries;
  for (std::size_t e = 0; e < lists.real[0].size(); ++e) entries.emplace_back(lists.whole[1][e], lists.whole[2][e], lists.real[0][e]);
  algebra::StoredMatrix lower;
  lower = algebra::from_triplets(lists.whole[0][0], lists.whole[0][0], entries);
  return lower;
}

/// Two cubes on their bottoms, each with a coarser mesh. Rows couple displacements of both tops, as mortar does, all three of a node, as oblique planes do, or
/// hold one with the other sign.
problem::Problem coupled_cubes() {
  constexpr int n = 6, kRows = 30;
  const test::ElasticCube cube = test::cube_on_its_bottom(n);
  const algebra::CoarseFunctions functions = test::functions_of_coarser(cube, n);
  problem::Problem p;
  for (int b = 0; b < 2; ++b) {
    problem::Block block;
    block.name = b == 0 ? "a" : "b";
    block.K = algebra::SparseMatrix(cube.lower * (1.0 + b));
    block.f = Vector::Zero(cube.lower.rows());
    block.node = cube.node;
    block.kernel.resize(cube.lower.rows(), 0);
    block.rigid = [motions = cube.motions] { return motions; };
    block.coarse = {{functions.coarse_nodes()}, 3, [functions](int levels) { return std::vector(static_cast<std::size_t>(levels), functions); }};
    add(p, std::move(block));
  }
  const int size = static_cast<int>(cube.node.size()), top = size - 3 * (n + 1) * (n + 1);
  algebra::Triplets entries;
  for (int r = 0; r < kRows; ++r) {
    const int at = top + 3 * r;  // x of a node of the top
    if (r % 3 == 0)
      for (const auto& [to, factor] : {std::pair{at + 2, 1.0}, {size + at + 2, -0.5}, {size + at + 5, -0.3}, {size + at + 23, -0.2}}) entries.emplace_back(r, to, factor);
    else if (r % 3 == 1)
      for (int i = 0; i < 3; ++i) entries.emplace_back(r, at + i, 0.48 + 0.08 * i);
    else entries.emplace_back(r, at + 2, -1);
  }
  p.B = algebra::from_triplets<algebra::SparseRows>(kRows, p.unknowns(), entries);
  p.c = Vector::Zero(kRows);
  p.groups = {test::group(problem::unilateral(), 0, kRows)};
  return p;
}

}  // namespace

TEST_CASE("slices of several bodies, whose rows couple many displacements, give what the whole matrix gives") {
  if (test::not_built()) return;
  REQUIRE(multigrid::starts());
  Monitor quiet;
  const problem::Problem whole = coupled_cubes();
  problem::Problem sliced = whole;
  const algebra::SparseMatrix K = problem::lower_stiffness(whole);
  const auto share = [&](const std::vector<char>&) {
    Share all{as_lists(K), {}};
    for (int i = 0; i < K.rows(); ++i) all.unknowns.push_back(i);
    return all;
  };
  const std::vector<int> node = nodes(whole);
  const std::vector<algebra::CoarseFunctions> functions = coarse_functions(whole);
  const multigrid::Coupling coupling{node, functions, whole.B, [](const auto&) {}};
  take_slices(sliced, multigrid::make_slices({coupling, share, {from_lists, nullptr}, {}}));
  REQUIRE(slices(sliced));
  const auto rigid = problem::rigid_motions(whole);
  const Vector u = test::Random(7).vector(whole.unknowns());
  const Vector force = problem::stiffness_times(whole, u);
  for (const bool precisely : {false, true}) {
    const auto field = problem::field(sliced, u);
    CHECK((problem::stiffness_times(sliced, algebra::LongField(*field), precisely).get() - force).norm() <= 1e-14 * force.norm());
  }
  for (std::size_t b = 0; b < 2; ++b) {  // each body's own part
    const problem::Block& part = sliced.blocks[b];
    const Vector own = u.segment(part.first, part.size());
    CHECK((part.K.times(own) - force.segment(part.first, part.size())).norm() <= 1e-14 * force.norm());
    CHECK((part.K.gross_times(own) - whole.blocks[b].K.gross_times(own)).norm() <= 1e-14 * force.norm());
    CHECK(algebra::SparseMatrix(part.K.lower() - whole.blocks[b].K.lower()).norm() == 0);
  }
  solver::HeldStiffness factored(whole, rigid, solver::factor(algebra::Ordering::automatic), quiet);
  solver::HeldStiffness iterated(sliced, rigid, solver::multigrid(solver::Levels::meshes), quiet);
  REQUIRE_FALSE(iterated.basis().of_signs());
  const algebra::SparseMatrix A = algebra::congruent(K, iterated.basis().T);
  for (const int layers : {0, 2}) {
    std::vector<char> of(static_cast<std::size_t>(whole.unknowns()), 0);
    for (const int unknown : iterated.basis().unknown) of[unknown] = unknown % 2;
    const algebra::SymmetricMatrix near = iterated.near(of, layers);
    algebra::each_entry_of(A, of, [&](int k, int row, int column) { CHECK(std::abs(near.lower().coeff(row, column) - A.valuePtr()[k]) <= 1e-12); });
  }
  test::Random random(12);
  for (int set = 0; set < 4; ++set) {
    Vector spring = Vector::Zero(whole.rows());
    std::vector<char> held(static_cast<std::size_t>(whole.unknowns()), 0);
    for (int r = 0; r < whole.rows(); ++r) {
      if ((r + set) % 4 == 0) held[iterated.basis().unknown[r]] = 1;
      else if ((r + set) % 4 == 1) spring[r] = random.between(0.1, 10);
    }
    REQUIRE(factored.factor(spring, held));
    REQUIRE(iterated.factor(spring, held));
    const Vector b = random.vector(whole.unknowns());
    const auto by = displaced(iterated, b, 1e-13);
    const Vector expected = displaced(factored, b).u, resistance = iterated.basis().forces(problem::stiffness_times(whole, expected));
    CHECK((by.u - expected).norm() <= 1e-9 * expected.norm());  // the condition, below 1e4, times the tolerance
    CHECK((by.resistance - resistance).norm() <= 1e-9 * resistance.norm());
  }
}
