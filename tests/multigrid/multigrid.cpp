#include "multigrid/multigrid.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "../support/random.hpp"
#include "algebra/direct/cholesky.hpp"
#include "base/error.hpp"
#include "built.hpp"
#include "elastic_cube.hpp"

using namespace dotyk;
using algebra::Vector;
using test::ElasticCube;

namespace {

std::unique_ptr<algebra::SpdSolver> solver_of(const ElasticCube& cube, Monitor& monitor) {
  return multigrid::make_solver({cube.lower, cube.node, [&] { return cube.motions; }}, monitor);
}

std::vector<char> none(const ElasticCube& cube) { return std::vector<char>(cube.node.size(), 0); }

Vector direct(const algebra::SparseMatrix& K, const std::vector<int>& node, const Vector& b) {
  algebra::Cholesky cholesky(K, node, {});
  REQUIRE(cholesky.factor(K));
  return cholesky.solve(b);
}

/// Solves with `held` and compares with the direct solver. The relative error of x is at most the condition, 2200 for 8 cells, times
/// the tolerance.
void compare(const ElasticCube& cube, algebra::SpdSolver& solver, const std::vector<char>& held) {
  const algebra::SparseMatrix K = test::holding(cube.lower, held);
  const Vector b = test::pressure_on_top(cube, held);
  REQUIRE(solver.set(test::entries(K), held));
  Vector left;
  const Vector rough = solver.solve(b, 1e-3, &left);
  CHECK((b - K.selfadjointView<Eigen::Lower>() * rough - left).norm() <= 1e-12 * b.norm());
  CHECK(left.norm() <= 1e-3 * b.norm());
  const Vector x = solver.solve(b, 1e-12), exact = direct(K, cube.node, b);
  CHECK((b - K.selfadjointView<Eigen::Lower>() * x).norm() <= 1.01e-12 * b.norm());
  CHECK((x - exact).norm() <= 1e-8 * exact.norm());
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) CHECK(x[static_cast<Eigen::Index>(i)] == 0);
}

}  // namespace

TEST_CASE("a cube on its bottom: the direct solution") {
  if (test::not_built()) return;
  Monitor monitor;
  const ElasticCube cube = test::cube_on_its_bottom(8);
  const auto solver = solver_of(cube, monitor);
  compare(cube, *solver, none(cube));
  CHECK(solver->levels() >= 2);
  CHECK(solver->bytes() >= 8.0 * static_cast<double>(cube.lower.nonZeros()));
  CHECK(solver->method().starts_with("conjugate gradients, algebraic multigrid (PETSc 3."));
}

TEST_CASE("iterations do not grow with the mesh") {
  if (test::not_built()) return;
  Monitor monitor;
  for (const int n : {6, 12}) {
    const ElasticCube cube = test::cube_on_its_bottom(n);
    const auto solver = solver_of(cube, monitor);
    for (const double radius : {0.0, 0.3}) {
      const auto held = test::disc_on_top(cube, radius);
      REQUIRE(solver->set(test::entries(test::holding(cube.lower, held)), held));
      const int before = solver->iterations();
      solver->solve(test::pressure_on_top(cube, held), 1e-8);
      // With a preconditioned matrix of condition κ the error's energy falls by the factor (√κ − 1)/(√κ + 1) an iteration: 10 for κ,
      // and one digit more for the residual, give 33. Without a hierarchy it takes 130 for n = 6, 230 for n = 12.
      CHECK(solver->iterations() - before <= 33);
    }
  }
}

TEST_CASE("unknowns held on the top, a new set of them each time") {
  if (test::not_built()) return;
  Monitor monitor;
  const ElasticCube cube = test::cube_on_its_bottom(7);
  const auto solver = solver_of(cube, monitor);
  for (const double radius : {0.3, 0.15, 0.0, 0.45, 2.0, 0.0}) compare(cube, *solver, test::disc_on_top(cube, radius));
}

TEST_CASE("a set of numbers leaves nothing of those before it") {
  if (test::not_built()) return;
  Monitor monitor;
  struct State {
    double radius;  // of what is held
    double spring;  // factor of a diagonal entry
  };
  const std::vector<State> no_springs{{0.3, 1}, {0.45, 1}, {0, 1}, {0.3, 1}}, springs{{0.3, 1}, {0.45, 1}, {0, 1000}, {0.3, 1000}, {0.3, 1}};
  const auto compare_states = [&](int n, bool meshes, int levels, const std::vector<State>& states) {
    const ElasticCube cube = test::cube_on_its_bottom(n);
    const std::vector<algebra::CoarseFunctions> coarse{test::functions_of_coarser(cube, n)};
    const auto make = [&] {
      multigrid::Matrix matrix{cube.lower, cube.node, [&] { return cube.motions; }};
      if (meshes) matrix.coarse = &coarse, matrix.near_kernel = [] { return algebra::DenseMatrix(); };
      return multigrid::make_solver(matrix, monitor);
    };
    const auto rough = [&](algebra::SpdSolver& solver, const State& state) {
      const std::vector<char> held = test::disc_on_top(cube, state.radius);
      algebra::SparseMatrix K = test::holding(cube.lower, held);
      K.coeffRef(0, 0) *= state.spring;
      REQUIRE(solver.set(test::entries(K), held));
      return solver.solve(test::pressure_on_top(cube, held), 1e-2);
    };
    const auto used = make();
    CHECK(used->levels() >= levels);
    // Bit by bit: after so few iterations x still shows what the preconditioner is.
    for (const State& state : states) {
      CHECK(rough(*used, state) == rough(*make(), state));
      CHECK(!used->set({{0, 0, -1.0}}, none(cube)));
    }
  };
  compare_states(8, false, 2, springs);
  compare_states(8, true, 2, springs);
  compare_states(14, false, 3, no_springs);
}

TEST_CASE("scattered unknowns held, whole nodes, and nearly all: coarse functions vanish or agree") {
  if (test::not_built()) return;
  Monitor monitor;
  test::Random random(5);
  const ElasticCube cube = test::cube_on_its_bottom(7);
  const auto solver = solver_of(cube, monitor);
  for (const int of_ten : {1, 5, 9, 10})
    for (const bool whole_nodes : {false, true}) {
      std::vector<char> held = none(cube);
      for (std::size_t i = 0; i < held.size(); ++i)
        held[i] = whole_nodes && i > 0 && cube.node[i] == cube.node[i - 1] ? held[i - 1] : random.below(10) < of_ten;
      compare(cube, *solver, held);
    }
}

TEST_CASE("nodes with different numbers of unknowns") {
  if (test::not_built()) return;
  Monitor monitor;
  const ElasticCube cube = test::elastic_cube(7, [](const std::array<double, 3>& p, int c) {
    return p[2] == 0 || (c == 0 && p[0] == 0) || (c == 1 && p[0] == 1 && p[1] == 1) || (c != 2 && p[2] == 1 && p[0] > 0.5);
  });
  const auto solver = solver_of(cube, monitor);
  for (const double radius : {0.0, 0.4}) compare(cube, *solver, test::disc_on_top(cube, radius));
}

TEST_CASE("without a near kernel, with dependent modes, of one unknown a node, of few unknowns") {
  if (test::not_built()) return;
  Monitor monitor;
  ElasticCube cube = test::cube_on_its_bottom(5);
  const algebra::DenseMatrix motions = cube.motions;
  cube.motions = algebra::DenseMatrix(motions.rows(), 0);
  compare(cube, *solver_of(cube, monitor), none(cube));
  cube.motions = algebra::DenseMatrix(motions.rows(), 8);
  cube.motions << motions, motions.col(2) - motions.col(4), Vector::Zero(motions.rows());
  compare(cube, *solver_of(cube, monitor), none(cube));
  for (std::size_t i = 0; i < cube.node.size(); ++i) cube.node[i] = static_cast<int>(i);
  compare(cube, *solver_of(cube, monitor), none(cube));
  for (const int n : {1, 2}) {
    const ElasticCube small = test::cube_on_its_bottom(n);
    compare(small, *solver_of(small, monitor), none(small));
  }
  const algebra::SparseMatrix nothing(0, 0);
  const auto empty = multigrid::make_solver({nothing, {}, [] { return algebra::DenseMatrix(0, 6); }}, monitor);
  CHECK(empty->set({}, {}));
  CHECK(empty->solve(Vector(), 1e-8).size() == 0);
}

namespace {

/// Nodes of a square grid, of so many unknowns each, held at one end and joined to their neighbours by springs of all directions.
ElasticCube springs(int edge, int unknowns, double unit, test::Random& random) {
  ElasticCube net;
  const int count = edge * edge * unknowns;
  algebra::DenseMatrix K = algebra::DenseMatrix::Zero(count, count);
  const auto join = [&](int a, int b) {
    const algebra::DenseMatrix spring = unit * random.positive_definite(unknowns, 1);
    K.block(a * unknowns, a * unknowns, unknowns, unknowns) += spring;
    if (b < 0) return;
    K.block(b * unknowns, b * unknowns, unknowns, unknowns) += spring;
    K.block(a * unknowns, b * unknowns, unknowns, unknowns) -= spring;
    K.block(b * unknowns, a * unknowns, unknowns, unknowns) -= spring;
  };
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const int node = y * edge + x;
      for (int k = 0; k < unknowns; ++k) net.node.push_back(node);
      if (y == 0) join(node, -1);
      if (x > 0) join(node, node - 1);
      if (y > 0) join(node, node - edge);
    }
  net.lower = algebra::DenseMatrix(K.triangularView<Eigen::Lower>()).sparseView();
  net.motions = algebra::DenseMatrix::Identity(unknowns, unknowns).replicate(edge * edge, 1);
  return net;
}

}  // namespace

TEST_CASE("nodes of one to six unknowns, in any unit: the direct solution") {
  if (test::not_built()) return;
  Monitor monitor;
  for (const int unknowns : {1, 2, 3, 4, 5, 6}) {
    CAPTURE(unknowns);
    std::vector<int> iterations;
    for (const double unit : {1.0, 0x1p-400, 0x1p+400}) {  // beyond floats
      test::Random random(9);
      const ElasticCube net = springs(12, unknowns, unit, random);
      const auto solver = solver_of(net, monitor);
      const Vector b = random.vector(static_cast<int>(net.node.size()));
      REQUIRE(solver->set({}, none(net)));
      const Vector x = solver->solve(b, 1e-12), exact = direct(net.lower, net.node, b);
      CHECK((x - exact).norm() <= 1e-9 * exact.norm());  // the condition is some 10³
      iterations.push_back(solver->iterations());
    }
    CHECK(iterations[0] <= 40);
    CHECK(iterations == std::vector(3, iterations[0]));
  }
  test::Random random(9);
  CHECK_THROWS_WITH(solver_of(springs(4, 7, 1, random), monitor), doctest::Contains("more than six unknowns"));
}

TEST_CASE("matrices that are not definite, or of another pattern") {
  if (test::not_built()) return;
  Monitor monitor;
  const ElasticCube cube = test::cube_on_its_bottom(5);
  const auto solver = solver_of(cube, monitor);
  const Vector b = test::pressure_on_top(cube, none(cube));
  algebra::SparseMatrix bad = cube.lower;
  bad.coeffRef(17, 17) = -1;
  CHECK_FALSE(solver->set(test::entries(bad), none(cube)));
  bad.coeffRef(17, 17) = std::nan("");
  CHECK_FALSE(solver->set(test::entries(bad), none(cube)));
  bad.coeffRef(17, 17) = 1e-3 * cube.lower.coeff(17, 17);  // the diagonal does not show it
  if (solver->set(test::entries(bad), none(cube))) CHECK_FALSE(solver->solve(b, 1e-10).allFinite());
  compare(cube, *solver, none(cube));
  const algebra::SparseMatrix other = test::cube_on_its_bottom(4).lower;
  CHECK_THROWS_AS(solver->set(test::entries(other), std::vector<char>(static_cast<std::size_t>(other.rows()), 0)), std::runtime_error);
  CHECK(solver->solve(Vector::Zero(b.size()), 1e-8).norm() == 0);
}

TEST_CASE("the monitor is asked in every iteration") {
  if (test::not_built()) return;
  struct Patience final : Monitor {
    bool stop() override {
      if (left < 0 && fails) throw std::logic_error("asked once too often");
      return --left < 0;
    }
    int left = 1 << 30;
    bool fails = false;
  } patience;
  const ElasticCube cube = test::cube_on_its_bottom(5);
  const auto held = none(cube);
  const auto solver = solver_of(cube, patience);
  REQUIRE(solver->set(test::entries(cube.lower), held));
  const Vector b = test::pressure_on_top(cube, held), x = solver->solve(b, 1e-8);
  for (const int after : {0, 1, 5}) {
    patience.left = after;
    CHECK_THROWS_AS(solver->solve(b, 1e-8), Interrupted);
  }
  patience.left = -1;
  CHECK_THROWS_AS(solver->set(test::entries(cube.lower), held), Interrupted);
  CHECK_THROWS_AS(solver_of(cube, patience), Interrupted);
  patience.fails = true;
  CHECK_THROWS_AS(solver->solve(b, 1e-8), std::logic_error);
  patience.left = 1 << 30;
  CHECK(solver->solve(b, 1e-8) == x);
}
