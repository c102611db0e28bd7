#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "algebra/congruent.hpp"
#include "built.hpp"
#include "elastic_cube.hpp"
#include "multigrid/multigrid.hpp"

using namespace dotyk;
using algebra::Vector;

namespace {

/// A cube on its bottom, with one coarser mesh.
struct Nested {
  static constexpr int n = 8;
  const test::ElasticCube cube = test::cube_on_its_bottom(n);
  const std::vector<algebra::CoarseFunctions> coarse{test::functions_of_coarser(cube, n)};
  Monitor monitor = {};

  /// `coarser` receives the matrix of the coarser mesh.
  std::unique_ptr<algebra::SpdSolver> solver(algebra::SymmetricMatrix* coarser, const algebra::Triplets* changed = nullptr) {
    multigrid::Matrix matrix{cube.lower, cube.node, [&] { return algebra::DenseMatrix(coarse[0].columns, 0); }};
    matrix.coarse = &coarse, matrix.coarser = coarser, matrix.changed = changed;
    return multigrid::make_solver(matrix, monitor);
  }
};

}  // namespace

TEST_CASE("the matrix of the next coarser mesh is told") {
  if (test::not_built()) return;
  Nested nested;
  const test::ElasticCube& cube = nested.cube;
  const algebra::SparseMatrix expected = algebra::congruent(cube.lower, test::as_matrix(nested.coarse[0].compact()));
  const auto silent = nested.solver(nullptr);
  const algebra::Triplets changed{{0, 0, 2 * cube.lower.coeff(0, 0)}};
  for (const algebra::Triplets* other : {static_cast<const algebra::Triplets*>(nullptr), &changed}) {  // of which it knows nothing
    algebra::SymmetricMatrix stiffness;
    const auto telling = nested.solver(&stiffness, other);
    const algebra::SparseMatrix& coarser = stiffness.lower();
    REQUIRE(coarser.rows() == expected.rows());
    CHECK(algebra::SparseMatrix(coarser - expected).norm() <= 1e-14 * expected.norm());  // sums of 27 numbers
    for (int j = 0; j < coarser.cols(); ++j) {
      const auto rows = std::span(coarser.innerIndexPtr() + coarser.outerIndexPtr()[j], coarser.innerIndexPtr() + coarser.outerIndexPtr()[j + 1]);
      CHECK(rows.front() == j);
      CHECK(std::ranges::is_sorted(rows));
    }
    if (other) continue;
    for (const double radius : {0.3, 0.0, 0.45, 0.3}) {  // what is held changes coarse functions, and back
      const std::vector<char> held = test::disc_on_top(cube, radius);
      const auto holding = test::entries(test::holding(cube.lower, held));
      const Vector b = test::pressure_on_top(cube, held);
      REQUIRE(silent->set(holding, held));
      REQUIRE(telling->set(holding, held));
      const int before[2] = {silent->iterations(), telling->iterations()};
      const Vector x = silent->solve(b, 1e-12), y = telling->solve(b, 1e-12);
      CHECK((x - y).norm() <= 1e-8 * x.norm());  // the condition, 2200, times the tolerance
      CHECK(silent->iterations() - before[0] == telling->iterations() - before[1]);
    }
  }
}

TEST_CASE("vectors that lie with slices do what vectors here do") {
  if (test::not_built()) return;
  Nested nested;
  algebra::SymmetricMatrix A;
  const auto solver = nested.solver(&A);
  REQUIRE(A.slices());
  const auto unknowns = static_cast<int>(A.rows());
  std::vector<int> watched;
  for (int i = 3; i < unknowns; i += 7) watched.push_back(i);
  Vector x(unknowns), y(unknowns);
  for (int i = 0; i < unknowns; ++i) x[i] = std::sin(1.0 + i), y[i] = std::cos(3.0 * i);
  const auto tried = [&](const std::shared_ptr<algebra::Vectors>& where) {
    algebra::Field a(where), b(where);
    a.put(x), b.put(y);
    Vector told(3);
    told << a.dot(b), a.moduli(), a.greatest();
    a.add(0.5, b);
    algebra::LongField sum(a);
    const algebra::LongField before = sum;
    sum.add(1e-9, b), sum.go_back(before, 0.25);
    b.set_watched(a.watched());
    return std::array{told, a.get(), b.get(), sum.high.get(), sum.low.get(), b.watched()};
  };
  const auto here = tried(algebra::vectors_here(unknowns, watched)), there = tried(A.slices()->vectors(watched));
  CHECK((here[0] - there[0]).norm() <= 1e-14 * here[0].norm());  // sums in another order
  for (std::size_t k = 1; k < here.size(); ++k) CHECK(here[k] == there[k]);
}

TEST_CASE("what slices tell is what their lower triangle says") {
  if (test::not_built()) return;
  Nested nested;
  algebra::SymmetricMatrix A;
  const auto solver = nested.solver(&A);
  REQUIRE(A.slices());
  const algebra::SparseMatrix& lower = A.lower();
  Vector x(A.rows());
  for (int i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + i);
  CHECK((A.times(x) - algebra::symmetric_product(lower, x)).norm() <= 1e-14 * A.gross_times(x).norm());
  CHECK((A.gross_times(x) - algebra::symmetric_product(lower, Vector(x.cwiseAbs()), [](double a) { return std::abs(a); })).norm() <= 1e-14 * A.gross_times(x).norm());
  // In extended precision, of a vector that needs it: sums of 81 products.
  const Vector low = Vector::Constant(x.size(), 1e-18);
  const algebra::LongVector product = algebra::symmetric_product(lower, algebra::LongVector(x.cast<long double>() + low.cast<long double>()));
  const auto vectors = A.slices()->vectors({});
  algebra::LongField u{algebra::Field(vectors)};
  algebra::Field left(vectors);
  u.high.put(x), u.low.put(low), left.put(product.cast<double>());
  A.slices()->take_product(u, true, left);  // but for the rounding of the product
  const Vector rounding = (product.cast<double>().cast<long double>() - product).cast<double>();
  CHECK((left.get() - rounding).norm() <= 1e-17 * A.gross_times(x).norm());
  left.put(Vector::Zero(x.size()));
  A.slices()->take_product(u, false, left);
  CHECK(left.get() == -A.times(x));
  int most = 0;
  std::vector<int> entries(static_cast<std::size_t>(lower.cols()), 0);
  for (int j = 0; j < lower.cols(); ++j) {
    CHECK(A.diagonal(j) == lower.coeff(j, j));
    for (algebra::SparseMatrix::InnerIterator it(lower, j); it; ++it) ++entries[it.row()], entries[j] += it.row() != j;
  }
  for (const int count : entries) most = std::max(most, count);
  CHECK(A.slices()->most_entries() >= most);
  std::vector<char> of(entries.size(), 0);
  for (std::size_t i = 0; i < of.size(); i += 7) of[i] = 1;
  const algebra::SparseMatrix near = A.slices()->near(of);
  Eigen::Index count = 0;
  algebra::each_entry_of(lower, of, [&](int k, int row, int column) {
    ++count;
    CHECK(std::abs(near.coeff(row, column) - lower.valuePtr()[k]) <= 1e-15 * std::abs(lower.valuePtr()[k]));  // PᵀKP is symmetric up to rounding
  });
  CHECK(near.nonZeros() == count);
  std::vector<char> wide(of.size(), 0), told = wide;
  wide[0] = told[0] = 1;
  for (int layer = 0; layer < 2; ++layer) {
    std::vector<char> wider = wide;
    algebra::each_entry_of(lower, wide, [&](int, int row, int column) { wider[row] = wider[column] = 1; });
    wide = wider;
  }
  A.slices()->near(told, 2);
  CHECK(told == wide);
}

TEST_CASE("a slice keeps its numbers, whatever solvers make of its matrix") {
  if (test::not_built()) return;
  Nested nested;
  algebra::SymmetricMatrix A;
  const auto finer = nested.solver(&A);
  const algebra::SparseMatrix& lower = A.lower();
  const auto size = static_cast<int>(A.rows());
  std::vector<int> node;
  for (int i = 0; i < size; ++i) node.push_back(i / 3);
  const auto make = [&] {
    multigrid::Matrix matrix{lower, node, [&] { return algebra::DenseMatrix(size, 0); }};
    matrix.slices = A.slices();
    return multigrid::make_solver(matrix, nested.monitor);
  };
  Vector x(size);
  for (int i = 0; i < size; ++i) x[i] = std::sin(1.0 + i);
  const Vector before = A.times(x);
  const std::vector<char> held(static_cast<std::size_t>(size), 0);
  const auto check = [&](algebra::SpdSolver& solver, const algebra::Triplets& changed) {
    REQUIRE(solver.set(changed, held));
    algebra::SparseMatrix now = lower;
    for (const auto& entry : changed) now.coeffRef(entry.row(), entry.col()) = entry.value();
    const Vector solution = solver.solve(algebra::symmetric_product(now, x), 1e-12, nullptr);
    CHECK((solution - x).norm() <= 1e-8 * x.norm());  // the condition, below 2200, times the tolerance
    CHECK(A.times(x) == before);
  };
  auto first = make();
  const auto second = make();  // has a copy
  const double d = A.diagonal(0);
  check(*first, {{0, 0, 2 * d}}), check(*second, {{0, 0, 3 * d}, {1, 1, 2 * A.diagonal(1)}});
  check(*first, {{0, 0, d}, {4, 4, 2 * A.diagonal(4)}});
  first.reset();
  CHECK(A.times(x) == before);
  const auto third = make();
  check(*third, {});
}
