#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/plate_laws.hpp"

using namespace dotyk;
using plate::Plate;
using plate::Solution;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;

namespace {

double contact_force(const Solution& s) {
  double sum = 0;
  for (const int row : s.model().obstacle_row)
    if (row >= 0) sum += s.result().state.lambda[row];
  return sum;
}

/// A clamped round plate of radius R under q < 0 on a flat obstacle at −δ: within r < b it lies flat, outside
/// u = a₁ + a₂ ln r + a₃ r² + a₄ r² ln r + q r⁴/64D with u = −δ, u' = 0, u″ = 0 at b and u = u' = 0 at R.
struct Pressed {
  double D, q, R, delta, b = 0;
  Eigen::Vector4d a{0, 0, 0, 0};

  Pressed(double stiffness, double load, double radius, double depth) : D(stiffness), q(load), R(radius), delta(depth) {
    double low = 1e-3 * R, high = 0.999 * R;  // u″(b) rises with b from below 0, where the plate would cut into the obstacle
    const double at_low = bent(low);
    for (int i = 0; i < 100; ++i) {
      b = (low + high) / 2;
      ((bent(b) > 0) == (at_low > 0) ? low : high) = b;
    }
    bent(b);
  }
  /// u″ at b with the other four conditions met.
  double bent(double at) {
    Eigen::Matrix4d A;
    A << row(at, 0), row(at, 1), row(R, 0), row(R, 1);
    a = A.fullPivLu().solve(Eigen::Vector4d(-delta - load(at, 0), -load(at, 1), -load(R, 0), -load(R, 1)));
    return row(at, 2).dot(a) + load(at, 2);
  }
  static Eigen::RowVector4d row(double r, int derivative) {
    const double l = std::log(r);
    if (derivative == 0) return {1, l, r * r, r * r * l};
    if (derivative == 1) return {0, 1 / r, 2 * r, r * (2 * l + 1)};
    return {0, -1 / (r * r), 2, 2 * l + 3};
  }
  double load(double r, int derivative) const {
    const double c = q / (64 * D);
    return derivative == 0 ? c * r * r * r * r : derivative == 1 ? 4 * c * r * r * r : 12 * c * r * r;
  }
  double deflection(double r) const { return r <= b ? -delta : row(r, 0).dot(a) + load(r, 0); }
  /// −q within b, and along the ring what the shear jumps by: Q = −D (u″ + u'/r)' is −D 4a₄/r − q r/2 outside, 0 inside.
  double force() const { return -std::numbers::pi * q * b * b + 2 * std::numbers::pi * b * (4 * D * a[3] / b + q * b / 2); }
};

}  // namespace

TEST_CASE("a round plate pressed flat on the ground: free radius, deflection and force against the closed form") {
  const Pressed exact(2, -20, 1, 0.02);
  CHECK(exact.b > 0.2);
  CHECK(exact.b < 0.8);
  for (const auto element : kElements) {
    double last = 0, now = 0;
    for (const int cells : {6, 12, 24}) {
      Plate p = test::plate_on(test::disc(test::Family::p1, cells), element, -20);
      p.D = 2;
      p.obstacle = [](double, double) { return -0.02; };
      test::support(p, "boundary", kHeld, kHeld);
      const auto s = test::solved(p);
      REQUIRE(s->result().converged);
      CHECK(s->result().state.lambda.minCoeff() >= 0);
      CHECK(contact_force(*s) + plate::reaction(*s, 0).force == doctest::Approx(-s->model().load.dot(s->model().space.motions().col(0))).epsilon(1e-9));
      last = now;
      now = 0;
      for (double r = 0.05; r < 1; r += 0.1) now = std::max(now, std::abs(s->deflection(r * std::cos(1), r * std::sin(1)) - exact.deflection(r)) / 0.02);
      if (cells == 24) {
        CHECK(contact_force(*s) == doctest::Approx(exact.force()).epsilon(0.02));
        for (std::size_t n = 0; n < s->model().obstacle_row.size(); ++n) {
          const double* x = s->plate().mesh->node(static_cast<int>(n));
          const int row = s->model().obstacle_row[n];
          if (row >= 0 && std::hypot(x[0], x[1]) > exact.b + 2.0 / cells) CHECK(s->result().state.lambda[row] == 0);
        }
      }
    }
    CAPTURE(last);
    CHECK(now < 0.02);
    CHECK(now < 0.5 * last);
  }
}

TEST_CASE("a plate that nothing but an obstacle holds lies flat on it; on a slope, too") {
  for (const auto element : kElements)
    for (const auto& [a, b, c] : {std::array{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, {-0.2, 0.4, -0.1}}) {
      test::Mesh m = test::rectangle(test::Family::p1, 6, 5, -1, 0, 1, 1.5);
      Plate p = test::plate_on(std::move(m), element, -2);
      p.obstacle = [a = a, b = b, c = c](double x, double y) { return a + b * x + c * y; };
      const auto s = test::solved(p);
      REQUIRE(s->result().converged);
      CHECK(contact_force(*s) == doctest::Approx(2 * 3).epsilon(1e-10));
      // It touches at vertices, and sags between them: by about q h⁴/384D.
      double gap = 0;
      for (int n = 0; n < s->plate().mesh->node_count(); ++n) {
        const double* x = s->plate().mesh->node(n);
        CHECK(s->vertex_deflection(n) > a + b * x[0] + c * x[1] - 1e-12);
        gap = std::max(gap, s->vertex_deflection(n) - (a + b * x[0] + c * x[1]));
      }
      CHECK(gap < 2 * std::pow(0.34, 4) / 384);
    }
}

TEST_CASE("an obstacle out of reach bears nothing; edges mind it, and it is none where it is -∞") {
  for (const auto element : kElements) {
    const auto solved = [&](plate::Field obstacle, test::LawChoice edge) {
      Plate p = test::plate_on(test::rectangle(test::Family::p1, 8, 8), element, -1);
      p.obstacle = std::move(obstacle);
      test::support(p, "", edge, kFree);
      return test::solved(p);
    };
    const auto none = solved({}, kHeld);
    for (const plate::Field& obstacle : {plate::Field([](double, double) { return -1.0; }), plate::Field([](double, double) { return -INFINITY; })}) {
      const auto s = solved(obstacle, kHeld);
      CHECK((s->freedoms() - none->freedoms()).norm() < 1e-12 * none->freedoms().norm());
      CHECK(contact_force(*s) == 0);
    }
    // Half of the plate over a hole: it does bear on what there is.
    const auto half = solved([](double x, double) { return x < 0.5 ? -0.001 : -INFINITY; }, kHeld);
    CHECK(contact_force(*half) > 0.01);
    CHECK(half->deflection(0.25, 0.5) > -0.0012);
    CHECK(half->deflection(0.75, 0.5) < -0.0013);
    // Over a block that is higher than Signorini's edge along one side of it the edge stays above the block, not above 0.
    const auto lifted = solved([](double x, double) { return x > 1 - 1e-9 ? 0.01 : -INFINITY; }, {&laws::signorini});
    CHECK(lifted->deflection(1, 0.5) > 0.01 - (element == plate::Element::morley ? 1e-12 : 1e-3));
    CHECK(lifted->deflection(0, 0.5) < 1e-3);
    // … and an obstacle under a free edge bears it.
    const auto lying = solved([](double, double) { return -0.05; }, kFree);
    CHECK(contact_force(*lying) == doctest::Approx(1).epsilon(1e-9));
  }
}
