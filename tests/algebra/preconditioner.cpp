#include "algebra/krylov/preconditioner.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "algebra/dense/decompositions.hpp"
#include "algebra/krylov/conjugate_gradient.hpp"
#include "base/error.hpp"
#include "spd_matrices.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// C as a dense matrix, by what lift makes of the identity.
DenseMatrix dense(const algebra::Preconditioner& C) { return C.lift(DenseMatrix::Identity(C.size(), C.size())); }

/// K x = b after `steps` steps of conjugate gradients preconditioned by M⁻¹ as it stands in every textbook.
Vector textbook(const DenseMatrix& K, const DenseMatrix& M, const Vector& b, int steps) {
  const algebra::Ldlt factor(M);
  Vector x = Vector::Zero(b.size()), r = b, z = factor.solve(r), p = z;
  for (int k = 0; k < steps; ++k) {
    const double alpha = r.dot(z) / p.dot(K * p), before = r.dot(z);
    x += alpha * p;
    r -= alpha * K * p;
    z = factor.solve(r);
    p = z + r.dot(z) / before * p;
  }
  return x;
}

}  // namespace

TEST_CASE("the maps of every preconditioner belong together") {
  test::Random random(3);
  const SparseMatrix lower = test::coupled(4, random);
  const DenseMatrix K = test::full(lower), some = random.matrix(static_cast<int>(K.rows()), 3);
  const algebra::NoPreconditioner none(lower);
  const algebra::Ssor ssor(lower), over(lower, 1.4);
  const algebra::IncompleteCholesky ic(lower);
  for (const algebra::Preconditioner* one : {static_cast<const algebra::Preconditioner*>(&none),
                                             static_cast<const algebra::Preconditioner*>(&ssor),
                                             static_cast<const algebra::Preconditioner*>(&over),
                                             static_cast<const algebra::Preconditioner*>(&ic)}) {
    const DenseMatrix C = dense(*one), Ci = C.inverse();
    CHECK(test::relative(one->times(some), K * some) < 1e-13);
    CHECK(test::relative(one->apply(some), Ci * K * Ci.transpose() * some) < 1e-12);
    CHECK(test::relative(one->forward(some), Ci * some) < 1e-12);
    CHECK(test::relative(one->backward(some), Ci.transpose() * some) < 1e-12);
    CHECK(test::relative(one->lift(some), C * some) < 1e-13);
  }
}

TEST_CASE("SSOR by Eisenstat's trick has the iterates of plainly preconditioned conjugate gradients") {
  test::Random random(5);
  for (const double omega : {0.7, 1.0, 1.5}) {
    const SparseMatrix lower = test::laplacian(7, 6, 5, 20);
    const DenseMatrix K = test::full(lower);
    const DenseMatrix L = K.triangularView<Eigen::StrictlyLower>(), D = K.diagonal().asDiagonal();
    const DenseMatrix M = (D / omega + L) * (D / omega).inverse() * (D / omega + L).transpose();
    const Vector b = random.vector(static_cast<int>(K.rows()));
    const algebra::Ssor ssor(lower, omega);
    Monitor monitor;
    for (const int steps : {1, 2, 5, 12}) {
      const auto r = algebra::conjugate_gradient(ssor, b, {.tolerance = 1e-15, .most = steps}, monitor);
      CHECK(r.iterations == steps);
      CHECK_FALSE(r.converged);
      CHECK(test::relative(r.x, textbook(K, M, b, steps)) < 1e-11);  // rounding, times what the steps amplify
    }
  }
}

TEST_CASE("incomplete Cholesky reproduces K on its pattern, and is exact where nothing fills in") {
  const SparseMatrix lower = test::laplacian(5, 4, 3);
  const algebra::IncompleteCholesky ic(lower);
  CHECK(ic.shift() == 0);
  const DenseMatrix L(ic.factor()), product = L * L.transpose(), K = test::full(lower);
  for (int j = 0; j < K.cols(); ++j)
    for (int i = 0; i < K.rows(); ++i)
      if (K(i, j) != 0) CHECK(product(i, j) == doctest::Approx(K(i, j)).epsilon(1e-14));
  const SparseMatrix chain = test::laplacian(30, 1, 1);
  const algebra::IncompleteCholesky exact(chain);
  const DenseMatrix C = dense(exact);
  CHECK(test::relative(C * C.transpose(), test::full(chain)) < 1e-14);
  test::Random random(1);
  Monitor monitor;
  CHECK(algebra::conjugate_gradient(exact, random.vector(30), {.tolerance = 1e-12}, monitor).iterations == 1);
}

TEST_CASE("where the incomplete factorisation breaks down the matrix is shifted, and it converges all the same") {
  // Kershaw's matrix: positive definite, with a negative pivot without fill-in.
  const DenseMatrix K{{3, -2, 0, 2}, {-2, 3, -2, 0}, {0, -2, 3, -2}, {2, 0, -2, 3}};
  REQUIRE(algebra::eigenvalues(K)[0] > 0);
  const SparseMatrix lower = test::lower(K);
  const algebra::IncompleteCholesky ic(lower);
  CHECK(ic.shift() > 0);
  const Vector b{{1, 2, 3, 4}};
  Monitor monitor;
  const auto r = algebra::conjugate_gradient(ic, b, {.tolerance = 1e-12}, monitor);
  CHECK(r.converged);
  CHECK(test::relative(r.x, K.inverse() * b) < 1e-11);
}

TEST_CASE("matrices that are not positive definite are refused") {
  const SparseMatrix zero = test::lower(DenseMatrix{{1, 0}, {0, 0}});
  CHECK_THROWS_AS(algebra::Ssor{zero}, InputError);
  const SparseMatrix indefinite = test::lower(DenseMatrix{{1, 2}, {2, 1}});
  const algebra::NoPreconditioner none(indefinite);
  Monitor monitor;
  CHECK_THROWS_AS(algebra::conjugate_gradient(none, Vector{{1, -1}}, {}, monitor), InputError);
  CHECK_THROWS_AS(algebra::Ssor(test::laplacian(2, 2, 2), 2.0), InputError);
}
