#include "algebra/krylov/conjugate_gradient.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "iterations.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Preconditioning;
using algebra::SparseMatrix;
using algebra::Vector;
using test::Stop;
using test::kPreconditionings;

TEST_CASE("conjugate gradients agree with the direct solution, by every preconditioner") {
  test::Random random(11);
  const SparseMatrix lower = test::coupled(6, random);
  const DenseMatrix K = test::full(lower);
  const double condition = K.norm() * K.inverse().norm();
  const Vector b = random.vector(static_cast<int>(K.rows())), exact = algebra::Ldlt(K).solve(b);
  Monitor monitor;
  int plain = 0;
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
      const auto r = algebra::conjugate_gradient(*C, b, {.tolerance = tolerance}, monitor);
      CHECK(r.converged);
      CHECK(r.residual <= tolerance);
      CHECK((b - K * r.x).norm() <= 1.01 * tolerance * b.norm());
      CHECK(test::relative(r.x, exact) <= condition * tolerance);
      if (tolerance == 1e-12 && kind == Preconditioning::none) plain = r.iterations;
      if (tolerance == 1e-12 && kind != Preconditioning::none) CHECK(r.iterations < plain);
    }
  }
}

TEST_CASE("as many iterations as unknowns, or distinct eigenvalues, suffice") {
  test::Random random(2);
  Monitor monitor;
  for (int n = 1; n <= 8; ++n) {
    const SparseMatrix lower = test::lower(random.positive_definite(n, 1));
    const algebra::NoPreconditioner none(lower);
    const auto r = algebra::conjugate_gradient(none, random.vector(n), {.tolerance = 1e-10}, monitor);
    CHECK(r.converged);
    CHECK(r.iterations <= n);
  }
  Vector diagonal(60);
  for (int i = 0; i < 60; ++i) diagonal[i] = 1 + i % 3;
  const SparseMatrix three = test::lower(diagonal.asDiagonal());
  const algebra::NoPreconditioner none(three);
  CHECK(algebra::conjugate_gradient(none, random.vector(60), {.tolerance = 1e-12}, monitor).iterations == 3);
}

TEST_CASE("zero takes no iteration; too fine a tolerance, too few iterations and a stop are told") {
  const SparseMatrix lower = test::laplacian(6, 6, 6);
  const Vector b = Vector::Ones(216);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    Monitor monitor;
    const auto zero = algebra::conjugate_gradient(*C, Vector::Zero(216), {}, monitor);
    CHECK(zero.converged);
    CHECK(zero.iterations == 0);
    CHECK(zero.x.norm() == 0);
    const auto fine = algebra::conjugate_gradient(*C, b, {.tolerance = 1e-30}, monitor);
    CHECK_FALSE(fine.converged);
    CHECK(fine.reason.find("rounding") != std::string::npos);
    CHECK(fine.residual < 1e-13);
    const auto few = algebra::conjugate_gradient(*C, b, {.tolerance = 1e-12, .most = 2}, monitor);
    CHECK_FALSE(few.converged);
    CHECK(few.iterations == 2);
    Stop stop(3);
    const auto stopped = algebra::conjugate_gradient(*C, b, {.tolerance = 1e-12}, stop);
    CHECK_FALSE(stopped.converged);
    CHECK(stopped.iterations == 3);
    CHECK(stopped.reason.find("stopped") != std::string::npos);
    CHECK(stopped.residual < 1);
    CHECK(stopped.residual > 1e-12);
    CHECK_THROWS_AS(algebra::conjugate_gradient(*C, b * std::nan(""), {}, monitor), InputError);
  }
}

TEST_CASE("no unknowns") {
  const SparseMatrix lower(0, 0);
  Monitor monitor;
  for (const auto kind : kPreconditionings)
    CHECK(algebra::conjugate_gradient(*algebra::make_preconditioner(kind, lower), Vector(0), {}, monitor).converged);
}

TEST_CASE("directions stored are conjugate, also those of several systems") {
  test::Random random(13);
  const SparseMatrix lower = test::laplacian(9, 7, 5, 100);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    algebra::ConjugateBasis basis;
    Monitor monitor;
    for (int k = 0; k < 3; ++k)
      CHECK(algebra::conjugate_gradient(*C, random.vector(315), {.tolerance = 1e-8}, monitor, {.basis = &basis, .store = true}).converged);
    const auto m = basis.count();
    const DenseMatrix P = basis.directions();
    CHECK((P.transpose() * C->apply(P) - DenseMatrix::Identity(m, m)).cwiseAbs().maxCoeff() < 1e-11);
    CHECK((basis.products() - C->apply(P)).norm() < 1e-11 * P.norm());
    CHECK(basis.bytes() >= 16.0 * 315 * static_cast<double>(m));
  }
}

TEST_CASE("the Lanczos vectors are orthonormal, T is QᵀÂQ, and its ends approach those of the spectrum") {
  test::Random random(17);
  const SparseMatrix lower = test::laplacian(8, 7, 6, 50);
  const Vector b = random.vector(336);
  for (const auto kind : kPreconditionings) {
    const auto C = algebra::make_preconditioner(kind, lower);
    const DenseMatrix A = C->apply(DenseMatrix::Identity(336, 336));
    const Vector spectrum = eigenvalues((A + A.transpose()) / 2);
    double before_low = INFINITY, before_high = 0;
    for (const int steps : {10, 20, 40}) {
      algebra::LanczosRecord record;
      Monitor monitor;
      algebra::conjugate_gradient(*C, b, {.tolerance = 1e-15, .most = steps}, monitor, {.record = &record});
      const auto m = record.steps();
      const DenseMatrix Q = record.vectors();
      CHECK((Q.transpose() * Q - DenseMatrix::Identity(m, m)).cwiseAbs().maxCoeff() < 1e-13);
      CHECK(record.loss() < 1e-10);  // what a step loses before it is orthogonalised
      DenseMatrix T = record.diagonal().asDiagonal();
      T.diagonal(1) = T.diagonal(-1) = record.off_diagonal();
      CHECK((T - Q.transpose() * A * Q).cwiseAbs().maxCoeff() < 1e-11 * spectrum[335]);
      const auto all = algebra::lowest_eigenpairs(record.diagonal(), record.off_diagonal(), static_cast<int>(m));
      CHECK(test::relative(T * all.vectors, all.vectors * all.values.asDiagonal()) < 1e-13);
      const double low = all.values[0], high = all.values[m - 1];
      CHECK(low >= spectrum[0] * (1 - 1e-12));
      CHECK(high <= spectrum[335] * (1 + 1e-12));
      CHECK(low <= before_low * (1 + 1e-12));
      CHECK(high >= before_high * (1 - 1e-12));
      before_low = low, before_high = high;
      const double residual = std::abs(record.last_coupling() * all.vectors(m - 1, 0));
      const Vector y = Q * all.vectors.col(0);
      CHECK((A * y - low * y).norm() == doctest::Approx(residual).epsilon(1e-6).scale(1e-8));
    }
    CHECK(before_low == doctest::Approx(spectrum[0]).epsilon(0.02));
    CHECK(before_high == doctest::Approx(spectrum[335]).epsilon(0.02));
  }
}
