#include <doctest/doctest.h>

#include "algebra/dense/decompositions.hpp"
#include "program/working_kkt.hpp"
#include "programs.hpp"

using namespace dotyk;
using test::DenseMatrix;
using test::Random;
using test::Vector;

namespace {

double residual(const program::QuadraticProgram& p, const std::vector<char>& taken, const program::WorkingKkt::Solution& s,
                const Vector& f, const Vector& h) {
  Vector z(p.unknowns() + p.rows()), b(z.size());
  z << s.p, s.y;
  b << f, h;
  for (int r = 0; r < p.rows(); ++r)
    if (!taken[r]) b[p.unknowns() + r] = 0;
  return (program::kkt_times(p, taken, z) - b).norm() / b.norm();
}

}  // namespace

TEST_CASE("a bordered factor solves as a fresh one does, while rows come and go") {
  Random random(331);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 25, m = 20;
    const auto p = test::quadratic(random.positive_definite(n, 1e-2), random.vector(n), random.matrix(m, n),
                                   Vector::Constant(m, -1), Vector::Constant(m, 1));
    std::vector<char> taken(m, 0);
    for (int r = 0; r < m; ++r) taken[r] = random.coin();
    program::WorkingKkt kkt(p);
    kkt.set(taken);
    const Vector f = random.vector(n), h = random.vector(m), none = Vector::Zero(m);
    kkt.solve(f, h, none);
    for (int change = 0; change < 100; ++change) {
      const int row = random.below(m);
      taken[row] = !taken[row];
      kkt.change(row, taken[row]);
      const auto s = kkt.solve(f, h, random.vector(m));
      CHECK(s.consistent);
      CHECK_FALSE(s.singular);
      CHECK(residual(p, taken, s, f, h) < 1e-11);
    }
    CHECK(kkt.factorisations() < 10);
  }
}

TEST_CASE("singular systems: solved where they are consistent, a direction of the kernel where not") {
  Random random(332);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 4 + trial % 10, rank = n / 2, m = n / 4 + 1;
    const DenseMatrix P = test::semidefinite(random, n, rank);
    DenseMatrix A = random.matrix(m, n);
    if (m > 1) A.row(m - 1) = A.row(0);  // dependent rows, too
    const auto p = test::quadratic(P, random.vector(n), A, Vector::Constant(m, -1), Vector::Constant(m, 1));
    program::WorkingKkt kkt(p);
    const std::vector<char> all(m, 1);
    kkt.set(all);
    const Vector x = random.vector(n), y = random.vector(m);
    const auto good = kkt.solve(P * x + A.transpose() * y, A * x, Vector::Zero(m));
    CHECK(good.consistent);
    CHECK(good.singular);
    CHECK(residual(p, all, good, P * x + A.transpose() * y, A * x) < 1e-8);
    const Vector f = random.vector(n);
    const auto bad = kkt.solve(f, Vector::Zero(m), Vector::Zero(m));
    CHECK_FALSE(bad.consistent);
    const Vector d = bad.p.normalized();
    CHECK((P * d).norm() < 1e-9);
    CHECK((A * d).norm() < 1e-9);
    CHECK(f.dot(d) > 0);
  }
}

TEST_CASE("the regularisation leaves a safely regular system untouched") {
  Random random(333);
  const int n = 15, m = 6;
  const DenseMatrix P = random.positive_definite(n, 1), A = random.matrix(m, n);
  const auto p = test::quadratic(P, random.vector(n), A, Vector::Zero(m), Vector::Zero(m));
  DenseMatrix K = DenseMatrix::Zero(n + m, n + m);
  K << P, A.transpose(), A, DenseMatrix::Zero(m, m);
  const Vector f = random.vector(n), h = random.vector(m);
  Vector b(n + m);
  b << f, h;
  const Vector exact = algebra::PivotedLu(K).solve(b);
  program::WorkingKkt kkt(p);
  kkt.set(std::vector<char>(m, 1));
  const auto s = kkt.solve(f, h, Vector::Zero(m));
  CHECK((s.p - exact.head(n)).norm() < 1e-13 * exact.norm() * K.norm());
  CHECK((s.y - exact.tail(m)).norm() < 1e-13 * exact.norm() * K.norm());
}
