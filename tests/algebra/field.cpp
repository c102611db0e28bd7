#include "algebra/field.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "../support/random.hpp"
#include "algebra/krylov/conjugate_residuals.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Field;
using algebra::Vector;

TEST_CASE("fields do what vectors do, on one thread and on several") {
  test::Random random(8);
  for (const int size : {0, 1, 7, 450'000}) {  // the last: enough numbers for several threads
    const auto here = algebra::vectors_here(size, {});
    const Vector a = random.vector(size), b = random.vector(size);
    Field x(here), y(here);
    CHECK(x.get() == Vector::Zero(size));
    x.put(a), y.put(b);
    CHECK(std::abs(x.dot(y) - a.dot(b)) <= 1e-15 * size);
    CHECK(x.moduli() == doctest::Approx(a.lpNorm<1>()).epsilon(1e-13));
    CHECK(x.greatest() == (size > 0 ? a.lpNorm<Eigen::Infinity>() : 0));
    const Field copy = x;
    x.add(-0.5, y);
    CHECK((x.get() - (a - 0.5 * b)).norm() <= 1e-15 * std::sqrt(size));
    CHECK(copy.get() == a);
    y = copy;
    CHECK(y.get() == a);
    y.swap(x);
    CHECK(x.get() == a);
  }
}

TEST_CASE("watched unknowns are told and set in their order; others stay") {
  const auto here = algebra::vectors_here(6, {1, 2, 5});
  Field x(here);
  x.put(Vector::LinSpaced(6, 0, 5));
  CHECK(x.watched() == Vector{{1, 2, 5}});
  x.set_watched(Vector{{-1, -2, -5}});
  CHECK(x.get() == Vector{{0, -1, -2, 3, 4, -5}});
}

TEST_CASE("a long field has the digits of extended precision") {
  constexpr int kSize = 1000, kSteps = 50;
  test::Random random(9);
  const auto here = algebra::vectors_here(kSize, {});
  algebra::LongField u{Field(here)};
  const algebra::LongField none = u;
  Field by(here);
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  Long expected = Long::Zero(kSize);
  const auto is_expected = [&] {
    const Vector high = u.high.get();
    CHECK((high.cast<long double>() + u.low.get().cast<long double>() - expected).lpNorm<Eigen::Infinity>() <= 2e-18L * expected.lpNorm<Eigen::Infinity>());
    CHECK(high == Vector(expected.cast<double>()));  // the rounded sum
  };
  for (int step = 0; step < kSteps; ++step) {
    const Vector change = std::pow(0.5, step) * random.vector(kSize);
    by.put(change);
    u.add(0.3, by);
    expected += static_cast<long double>(0.3) * change.cast<long double>();
  }
  is_expected();
  u.go_back(none, 0.25);
  expected *= 0.25L;
  is_expected();
  u.go_back(none, 0);
  CHECK(u.high.moduli() + u.low.moduli() == 0);
}

TEST_CASE("a number that is none is seen in the sum of moduli, wherever it is") {
  for (const int at : {0, 3, 9}) {
    Field x(algebra::vectors_here(10, {}));
    Vector numbers = Vector::Ones(10);
    numbers[at] = std::numeric_limits<double>::quiet_NaN();
    x.put(numbers);
    CHECK_FALSE(std::isfinite(x.moduli()));
  }
}

TEST_CASE("conjugate residuals solve with a matrix that is not symmetric") {
  constexpr int kSize = 40;
  test::Random random(10);
  const auto here = algebra::vectors_here(kSize, {});
  for (int trial = 0; trial < 10; ++trial) {
    DenseMatrix A = DenseMatrix::Identity(kSize, kSize);
    for (int j = 0; j < kSize; ++j) A.col(j) += 0.4 / std::sqrt(kSize) * random.vector(kSize);  // near the preconditioner, which is the identity
    const Vector b = random.vector(kSize);
    Vector u = Vector::Zero(kSize);
    const auto field = [&](const Vector& numbers) {
      Field out(here);
      out.put(numbers);
      return out;
    };
    algebra::conjugate_residuals(
        [&](const std::optional<Field>& by) -> algebra::Remainder {
          if (by) u += by->get();
          return {field(b - A * u), 1e-12 * b.lpNorm<1>()};
        },
        [&](const Field& left) -> algebra::ResidualDirection { return {left, field(A * left.get())}; });
    CHECK((b - A * u).lpNorm<1>() <= 1e-12 * b.lpNorm<1>());
  }
}
