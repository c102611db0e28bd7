#include "algebra/krylov/repeated_systems.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/krylov/block_cg.hpp"
#include "base/error.hpp"
#include "iterations.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Preconditioning;
using algebra::RepeatedSettings;
using algebra::SparseMatrix;
using algebra::Vector;
using test::Stop;
using test::kPreconditionings;
using Method = RepeatedSettings::Method;

namespace {

constexpr Method kMethods[] = {Method::cholesky, Method::cg, Method::scg, Method::cglan, Method::block_cg};

/// Smooth right-hand sides on the grid, as sensitivities of a slender body are; column k varies as x^k.
DenseMatrix smooth(int nx, int ny, int nz, int columns) {
  DenseMatrix b(nx * ny * nz, columns);
  for (int i = 0; i < b.rows(); ++i)
    for (int k = 0; k < columns; ++k) b(i, k) = std::pow((i % nx + 1.0) / (nx + 1), k) + 0.1 * (i / nx % ny);
  return b;
}

}  // namespace

TEST_CASE("every method agrees with the direct solution, right-hand sides at once or one after the other") {
  test::Random random(23);
  const SparseMatrix lower = test::coupled(6, random);
  const DenseMatrix K = test::full(lower), B = random.matrix(216, 5), exact = algebra::Ldlt(K).solve(B);
  const double condition = K.norm() * K.inverse().norm();
  Monitor monitor;
  for (const Method method : kMethods)
    for (const auto kind : kPreconditionings)
      for (const bool more : {false, true})
        for (const double tolerance : {1e-6, 1e-11}) {
          RepeatedSettings settings{.method = method, .preconditioning = kind, .cg = {.tolerance = tolerance}, .extend = more, .deflate = more};
          algebra::RepeatedSystems systems(lower, test::each_its_own(216), settings);
          const DenseMatrix first = systems.solve(B.leftCols(2), monitor), second = systems.solve(B.rightCols(3), monitor);
          CHECK(test::relative(first, exact.leftCols(2)) <= condition * tolerance);
          CHECK(test::relative(second, exact.rightCols(3)) <= condition * tolerance);
          REQUIRE(systems.results().size() == 5);
          for (const auto& r : systems.results()) {
            CHECK(r.converged);
            CHECK(r.residual <= tolerance);
            CHECK((method == Method::cholesky) == (r.iterations == 0));
          }
        }
}

TEST_CASE("successive conjugate gradients: nothing left to do within the span, less outside it, less again when extended") {
  const SparseMatrix lower = test::laplacian(30, 4, 4);
  const DenseMatrix B = smooth(30, 4, 4, 4);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    Monitor monitor;
    const algebra::CgSettings settings{.tolerance = 1e-8};
    algebra::SuccessiveCg scg(*C, settings), extended(*C, settings, true);
    const int first = scg.solve(B.col(0), monitor).iterations;
    CHECK(scg.basis().count() == first);
    CHECK(extended.solve(B.col(0), monitor).iterations == first);
    test::Random random(1);
    const Vector inside = C->lift(scg.basis().products() * random.vector(first));
    const auto none = scg.solve(inside, monitor);
    CHECK(none.iterations == 0);
    CHECK(none.converged);
    CHECK((inside - Vector(C->times(none.x))).norm() <= 1e-8 * inside.norm());
    CHECK(scg.solve(2 * B.col(0), monitor).iterations == 0);
    int plain = 0, later = 0, added = 0;
    for (int k = 1; k < 4; ++k) {
      plain += algebra::conjugate_gradient(*C, B.col(k), settings, monitor).iterations;
      later += scg.solve(B.col(k), monitor).iterations;
      added += extended.solve(B.col(k), monitor).iterations;
    }
    CHECK(later < plain);
    CHECK(added <= later);
    CHECK(extended.basis().count() == first + added);
    CHECK(extended.solve(B * Vector{{1, -2, 3, 1}}, monitor).iterations == 0);
  }
}

TEST_CASE("CGLAN: the number of vectors is where the gap is largest, and they spare iterations") {
  Vector values = Vector::LinSpaced(31, 1, 31);
  CHECK(algebra::number_by_gap(values) == 10);
  values.tail(14) *= 5;
  CHECK(algebra::number_by_gap(values) == 17);
  values[4] = 3;  // a larger gap before the tenth does not count
  CHECK(algebra::number_by_gap(values) == 17);
  CHECK(algebra::number_by_gap(Vector{{1, 2, 10}}) == 2);
  CHECK(algebra::number_by_gap(Vector{{1}}) == 1);
  CHECK(algebra::number_by_gap(Vector()) == 0);

  const SparseMatrix lower = test::laplacian(60, 4, 4);
  test::Random random(29);
  const DenseMatrix B = random.matrix(960, 4);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    Monitor monitor;
    const algebra::CgSettings settings{.tolerance = 1e-8};
    int plain = 0, started = 0, deflated = 0;
    algebra::Cglan start(*C, settings, false), deflate(*C, settings, true);
    CHECK(start.solve(Vector::Zero(960), monitor).iterations == 0);  // nothing to be learnt from
    CHECK(start.basis().count() == 0);
    for (int k = 0; k < 4; ++k) {
      plain += algebra::conjugate_gradient(*C, B.col(k), settings, monitor).iterations;
      started += start.solve(B.col(k), monitor).iterations;
      deflated += deflate.solve(B.col(k), monitor).iterations;
    }
    CHECK(start.basis().count() >= 10);
    CHECK(start.basis().count() <= 30);
    CHECK(start.values().size() == start.basis().count());
    CHECK(start.loss() < 1e-8);
    CHECK(started <= plain);
    CHECK(deflated < plain);
    CHECK(deflated <= started);
  }
}

TEST_CASE("block conjugate gradients: equal, dependent and zero right-hand sides; fewer steps than one by one") {
  const SparseMatrix lower = test::laplacian(12, 8, 6);
  const DenseMatrix K = test::full(lower);
  test::Random random(31);
  DenseMatrix B = random.matrix(576, 6);
  B.col(1) = B.col(0);
  B.col(2).setZero();
  B.col(4) = 1e-9 * (B.col(0) - 3 * B.col(3));
  const DenseMatrix exact = algebra::Ldlt(K).solve(B);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    Monitor monitor;
    const auto r = algebra::block_cg(*C, B, {.tolerance = 1e-9}, monitor);
    CHECK(r.converged);
    CHECK(r.settled[2] == 0);
    CHECK(r.x.col(2).norm() == 0);
    CHECK(r.least_rank <= 3);
    CHECK(r.products <= 3L * r.iterations);
    for (int k = 0; k < 6; ++k)
      if (k != 2) {
        CHECK(r.residual[static_cast<std::size_t>(k)] <= 1e-9);
        CHECK(test::relative(r.x.col(k), exact.col(k)) < 1e-7);  // the condition number is below 100
        CHECK(r.iterations < algebra::conjugate_gradient(*C, B.col(k), {.tolerance = 1e-9}, monitor).iterations);
      }
    Stop stop(2);
    const auto stopped = algebra::block_cg(*C, B, {.tolerance = 1e-9}, stop);
    CHECK_FALSE(stopped.converged);
    CHECK(stopped.iterations == 2);
    CHECK(algebra::block_cg(*C, DenseMatrix::Zero(576, 2), {}, monitor).iterations == 0);
    CHECK(algebra::block_cg(*C, DenseMatrix(576, 0), {}, monitor).converged);
  }
}

TEST_CASE("zero takes no iteration, a stop ends all systems, and indefinite matrices are refused, by every method") {
  const SparseMatrix lower = test::laplacian(8, 8, 8);
  DenseMatrix B = smooth(8, 8, 8, 3);
  B.col(1).setZero();
  for (const Method method : kMethods) {
    const RepeatedSettings settings{.method = method, .cg = {.tolerance = 1e-9}};
    algebra::RepeatedSystems systems(lower, test::each_its_own(512), settings);
    Monitor monitor;
    const DenseMatrix x = systems.solve(B, monitor);
    CHECK(x.col(1).norm() == 0);
    CHECK(systems.results()[1].iterations == 0);
    CHECK(systems.results()[1].converged);
    CHECK_THROWS_AS(systems.solve(DenseMatrix::Ones(5, 1), monitor), InputError);
    if (method == Method::cholesky) continue;
    algebra::RepeatedSystems stopped(lower, test::each_its_own(512), settings);
    Stop stop(4);
    stopped.solve(B, stop);
    for (const int k : {0, 2}) {
      CHECK_FALSE(stopped.results()[k].converged);
      CHECK(stopped.results()[k].reason != "");
    }
  }
  const SparseMatrix indefinite = test::lower(DenseMatrix{{1, 2}, {2, 1}});
  Monitor monitor;
  for (const Method method : kMethods)
    CHECK_THROWS_AS(algebra::RepeatedSystems(indefinite, {0, 1}, {.method = method, .cg = {}}).solve(DenseMatrix{{1}, {-1}}, monitor), InputError);
}

TEST_CASE("tolerances below rounding: every method ends by rounding as near as the direct solution, or meets them") {
  const SparseMatrix lower = test::laplacian(30, 4, 4, 1e4);
  const DenseMatrix K = test::full(lower);
  DenseMatrix B(480, 3);
  B << smooth(30, 4, 4, 2), smooth(30, 4, 4, 2) * Vector{{2, -1}};
  const DenseMatrix exact = algebra::Ldlt(K).solve(B);
  Monitor monitor;
  for (const double scale : {1.0, 1e-180, 1e200})  // squares of such loads vanish or overflow
    for (const Method method : kMethods)
      for (const auto kind : kPreconditionings)
        for (const bool more : {false, true})
          for (const double tolerance : {1e-12, 1e-16, 1e-300}) {
            if (method == Method::cholesky) continue;
            RepeatedSettings settings{.method = method, .preconditioning = kind, .cg = {.tolerance = tolerance}, .extend = more, .deflate = more};
            algebra::RepeatedSystems systems(lower, test::each_its_own(480), settings);
            const DenseMatrix x = systems.solve(scale * B, monitor) / scale;
            REQUIRE(x.allFinite());
            // ε times the condition number, some 1e6
            CHECK(test::relative(x, exact) < 1e-9);
            for (const auto& r : systems.results()) {
              INFO(r.reason);
              CHECK(r.residual < 1e-9);
              CHECK(r.converged == (r.residual <= tolerance));
              CHECK((r.converged || r.reason.find("rounding") == 0));
            }
          }
}

TEST_CASE("what a conjugate basis lets pass is conjugate to it, also where rounding is all that is left of a direction") {
  test::Random random(3);
  const SparseMatrix lower = test::laplacian(9, 7, 5, 100);
  const auto C = algebra::make_preconditioner(Preconditioning::ssor, lower);
  Monitor monitor;
  algebra::ConjugateBasis basis;
  algebra::conjugate_gradient(*C, random.vector(315), {.tolerance = 1e-8}, monitor, {.basis = &basis, .store = true});
  Vector inside = basis.directions() * random.vector(static_cast<int>(basis.count())), outside = random.vector(315);
  const double whole = inside.norm();
  CHECK((!basis.conjugate(inside) || (basis.products().transpose() * inside).norm() < 1e-12 * inside.norm()));
  CHECK(inside.norm() < 1e-12 * whole);
  CHECK(basis.conjugate(outside));
  CHECK((basis.products().transpose() * outside).norm() < 1e-12 * outside.norm());
  Vector zero = Vector::Zero(315);
  CHECK_FALSE(basis.conjugate(zero));
}
