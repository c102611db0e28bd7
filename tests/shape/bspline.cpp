#include "shape/design/bspline.hpp"

#include <doctest/doctest.h>

#include "base/error.hpp"

using namespace dotyk;
using algebra::Vector;
using shape::BSplines;

namespace {

/// Greville's abscissae: Σ ξ_i N_i(t) = t on open knots.
Vector abscissae(int degree, int count) {
  Vector xi = Vector::Zero(count);
  for (int i = 0; i < count; ++i)
    for (int k = 1; k <= degree; ++k) xi[i] += std::clamp(double(i + k - degree), 0.0, double(count - degree)) / (count - degree) / degree;
  return xi;
}

}  // namespace

TEST_CASE("B-splines are a nonnegative partition of unity on degree + 1 of them at a time") {
  for (const auto ends : {BSplines::Ends::open, BSplines::Ends::periodic})
    for (int degree : {1, 2, 3})
      for (int count : {degree + 1, degree + 2, 6, 13})
        for (int k = 0; k <= 200; ++k) {
          const Vector n = BSplines(degree, count, ends).values(k / 200.0);
          CHECK(n.size() == count);
          CHECK(n.minCoeff() >= 0);
          CHECK(n.sum() == doctest::Approx(1).epsilon(1e-14));
          CHECK((n.array() > 0).count() <= degree + 1);
        }
}

TEST_CASE("open B-splines begin and end at their end control points, and reproduce straight lines") {
  for (int degree : {1, 2, 3})
    for (int count : {degree + 1, 6, 9}) {
      const BSplines s(degree, count);
      CHECK(s.values(0)[0] == 1);
      CHECK(s.values(1)[count - 1] == 1);
      const Vector xi = abscissae(degree, count);
      for (int k = 0; k <= 50; ++k) CHECK(s.values(k / 50.0).dot(xi) == doctest::Approx(k / 50.0).epsilon(1e-14));
    }
}

TEST_CASE("with degree + 1 control points they are Bernstein's polynomials; inside uniform cubics are 1/6, 4/6, 1/6 at a knot") {
  for (double t : {0.0, 0.2, 0.7, 1.0}) {
    const Vector n = BSplines(3, 4).values(t);
    const double u = 1 - t, exact[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    for (int i = 0; i < 4; ++i) CHECK(n[i] == doctest::Approx(exact[i]).epsilon(1e-14));
  }
  const Vector n = BSplines(3, 12).values(4.0 / 9);  // the knot in the middle of splines 4, 5, 6
  CHECK(n[4] == doctest::Approx(1.0 / 6));
  CHECK(n[5] == doctest::Approx(4.0 / 6));
  CHECK(n[6] == doctest::Approx(1.0 / 6));
}

TEST_CASE("across knots all derivatives up to degree - 1 are continuous, round the end of periodic ones, too") {
  const double h = 1e-3;
  for (const auto ends : {BSplines::Ends::open, BSplines::Ends::periodic})
    for (int degree : {1, 2, 3}) {
      const int count = 8, spans = ends == BSplines::Ends::open ? count - degree : count;
      const BSplines s(degree, count, ends);
      const auto at = [&](double t) { return s.values(t - std::floor(t)); };
      for (int knot = ends == BSplines::Ends::open ? 1 : 0; knot < spans; ++knot) {
        const double t = double(knot) / spans;
        Vector left, right;  // differences of order degree - 1 within the spans beside the knot; polynomials there
        if (degree == 1) left = at(t - 1e-12), right = at(t + 1e-12);
        if (degree == 2) left = (3 * at(t) - 4 * at(t - h) + at(t - 2 * h)) / (2 * h), right = -(3 * at(t) - 4 * at(t + h) + at(t + 2 * h)) / (2 * h);
        if (degree == 3) {
          left = (2 * at(t) - 5 * at(t - h) + 4 * at(t - 2 * h) - at(t - 3 * h)) / (h * h);
          right = (2 * at(t) - 5 * at(t + h) + 4 * at(t + 2 * h) - at(t + 3 * h)) / (h * h);
        }
        CHECK((left - right).lpNorm<Eigen::Infinity>() < 1e-7);  // rounding 1e-16 / h², spans to the second power
      }
    }
}

TEST_CASE("B-splines that do not exist are refused") {
  CHECK_THROWS_WITH_AS(BSplines(4, 8), "the degree of B-splines is 4; it must be 1, 2 or 3", InputError);
  CHECK_THROWS_AS(BSplines(0, 8), InputError);
  CHECK_THROWS_WITH_AS(BSplines(3, 3), "B-splines of degree 3 with 3 control points; they need at least 4", InputError);
}

TEST_CASE("symmetric ties make one variable of control points opposite one another") {
  const auto even = shape::symmetric_ties(6), odd = shape::symmetric_ties(5);
  CHECK(even.cols() == 3);
  CHECK(odd.cols() == 3);
  for (const auto& T : {even, odd})
    for (Eigen::Index i = 0; i < T.rows(); ++i) {
      CHECK(T.row(i) == T.row(T.rows() - 1 - i));
      CHECK(T.row(i).sum() == 1);
    }
  CHECK(even.colwise().sum() == Eigen::RowVector3d(2, 2, 2));
  CHECK(odd.colwise().sum() == Eigen::RowVector3d(2, 2, 1));
  const BSplines s(3, 6);  // a symmetric curve
  for (double t : {0.1, 0.35}) CHECK((s.values(t).transpose() * even - s.values(1 - t).transpose() * even).norm() < 1e-14);
}
