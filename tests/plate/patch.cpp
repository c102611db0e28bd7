#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/plates.hpp"

using namespace dotyk;
using namespace dotyk::plate;
using Eigen::Vector2d;
using test::kD;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kNu;
using test::LawChoice;

namespace {

/// a cubic in x and y; Δ² of it is 0, so no load is needed within.
struct Cubic {
  std::array<double, 10> c;  // 1, x, y, x², xy, y², x³, x²y, xy², y³
  double u(double x, double y) const {
    return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y + c[6] * x * x * x + c[7] * x * x * y + c[8] * x * y * y + c[9] * y * y * y;
  }
  Vector2d slope(double x, double y) const {
    return {c[1] + 2 * c[3] * x + c[4] * y + 3 * c[6] * x * x + 2 * c[7] * x * y + c[8] * y * y,
            c[2] + c[4] * x + 2 * c[5] * y + c[7] * x * x + 2 * c[8] * x * y + 3 * c[9] * y * y};
  }
  double xx(double x, double y) const { return 2 * c[3] + 6 * c[6] * x + 2 * c[7] * y; }
  double yy(double x, double y) const { return 2 * c[5] + 2 * c[8] * x + 6 * c[9] * y; }
  double xy(double x, double y) const { return c[4] + 2 * c[7] * x + 2 * c[8] * y; }
  Vector2d gradient_of_laplacian() const { return {6 * c[6] + 2 * c[8], 2 * c[7] + 6 * c[9]}; }

  /// P5 (5) and (6), n outwards.
  double bending(double x, double y, const Vector2d& n) const {
    const double nn = n[0] * n[0] * xx(x, y) + 2 * n[0] * n[1] * xy(x, y) + n[1] * n[1] * yy(x, y);
    return -kD * (kNu * (xx(x, y) + yy(x, y)) + (1 - kNu) * nn);
  }
  double twist(double x, double y, const Vector2d& n) const {
    return -kD * (1 - kNu) * (n[0] * n[1] * (yy(x, y) - xx(x, y)) + (n[0] * n[0] - n[1] * n[1]) * xy(x, y));
  }
  /// T_n = −D ∂n Δu + ∂τ H_n, a constant on a straight edge.
  double shear(const Vector2d& n) const {
    const Vector2d t(-n[1], n[0]);
    return -kD * n.dot(gradient_of_laplacian()) + twist(t[0], t[1], n) - twist(0, 0, n);
  }
  Eigen::Matrix<double, 6, 1> values(double x, double y) const {
    Eigen::Matrix<double, 6, 1> v;
    v << u(x, y), slope(x, y), xx(x, y), yy(x, y), 2 * xy(x, y);
    return v;
  }
};

const Cubic kQuadratic{{0.2, -0.3, 0.5, 0.7, -0.4, 1.1, 0, 0, 0, 0}};
const Cubic kCubic{{0.2, -0.3, 0.5, 0.7, -0.4, 1.1, -0.6, 0.9, 0.35, 0.8}};

/// A quadrilateral without right angles, its corners counter-clockwise from the lower left one; cells of any shapes.
test::Mesh quadrilateral(int n) {
  test::Mesh m = test::rectangle(test::Family::p1, n, n);
  test::distort(m, 0.06);
  mesh::transform(m, [](const test::Point& x) { return test::Point{1.7 * x[0] + 0.3 * x[1] - 0.2 * x[0] * x[1], 0.2 * x[0] + 1.1 * x[1] + 0.3 * x[0] * x[1], 0}; });
  return m;
}
const Vector2d kCorners[4] = {{0, 0}, {1.7, 0.2}, {1.8, 1.6}, {0.3, 1.1}};
const char* const kParts[4] = {"bottom", "right", "top", "left"};
Vector2d normal(int side) {
  const Vector2d along = (kCorners[(side + 1) % 4] - kCorners[side]).normalized();
  return {along[1], -along[0]};
}

Plate plate_of(Element element) {
  Plate p = test::plate_on(quadrilateral(5), element);
  p.D = kD, p.nu = kNu;
  return p;
}

void check(const Plate& p, const Cubic& exact, double tolerance) {
  const auto s = test::solved(p);
  REQUIRE(s->result().converged);
  const auto off = test::error(*s, [&](double x, double y) { return exact.values(x, y); });
  CHECK(off.deflection < tolerance);
  CHECK(off.slope < tolerance);
  CHECK(off.curvature < 10 * tolerance);
}

LawField loaded(std::function<double(double, double)> force) {
  return [force](double x, double y) { return LawChoice{&laws::load, force(x, y)}; };
}

LawField held_deflection(const Cubic& exact) { return test::prescribed([exact](double x, double y) { return exact.u(x, y); }); }
LawField held_rotation(const Cubic& exact, int side) { return test::prescribed([exact, n = normal(side)](double x, double y) { return n.dot(exact.slope(x, y)); }); }
LawField moment(const Cubic& exact, int side) { return loaded([exact, n = normal(side)](double x, double y) { return -exact.bending(x, y, n); }); }
LawField force(const Cubic& exact, int side) { return loaded([exact, n = normal(side)](double, double) { return exact.shear(n); }); }

/// Green's formula (11) of P5 leaves H_n's jumps at the corners.
void load_corner(Plate& p, const Cubic& exact, int k) {
  const double jump = exact.twist(kCorners[k][0], kCorners[k][1], normal(k)) - exact.twist(kCorners[k][0], kCorners[k][1], normal((k + 3) % 4));
  p.point_loads.push_back({kCorners[k][0], kCorners[k][1], jump});
}

const Cubic& exact_for(Element element) { return element == Element::morley ? kQuadratic : kCubic; }

}  // namespace

// Tolerances: rounding of K, whose condition is about h⁻⁴; slopes that follow from prescribed deflections are differences of these.

TEST_CASE("patch test, deflection and rotation prescribed by functions") {
  for (const Element element : kElements)
    for (const Cubic& exact : {kQuadratic, exact_for(element)}) {
      Plate p = plate_of(element);
      for (int side = 0; side < 4; ++side) test::support(p, kParts[side], held_deflection(exact), held_rotation(exact, side));
      check(p, exact, 1e-10);
    }
}

TEST_CASE("patch test, two sides held, two loaded by moments and forces, forces at corners") {
  for (const Element element : kElements)
    for (const Cubic& exact : {kQuadratic, exact_for(element)}) {
      Plate p = plate_of(element);
      test::support(p, "bottom", held_deflection(exact), held_rotation(exact, 0));
      test::support(p, "right", held_deflection(exact), moment(exact, 1));
      for (const int side : {2, 3}) test::support(p, kParts[side], force(exact, side), moment(exact, side));
      load_corner(p, exact, 3);
      check(p, exact, 1e-10);
    }
}

TEST_CASE("patch test, deflection free of one side, its rotation held") {
  for (const Element element : kElements) {
    const Cubic& exact = exact_for(element);
    Plate p = plate_of(element);
    for (const int side : {0, 1, 2}) test::support(p, kParts[side], held_deflection(exact), moment(exact, side));
    test::support(p, "left", force(exact, 3), held_rotation(exact, 3));
    check(p, exact, 1e-10);
  }
}

TEST_CASE("patch test, a free plate under moments, forces and corner forces alone; its mean and first moments vanish") {
  for (const Element element : kElements) {
    const Cubic& exact = exact_for(element);
    Plate p = plate_of(element);
    for (int side = 0; side < 4; ++side) {
      test::support(p, kParts[side], force(exact, side), moment(exact, side));
      load_corner(p, exact, side);
    }
    const auto s = test::solved(p);
    REQUIRE(s->result().converged);
    const auto weighted = [&](int k, bool own) {
      return test::integrate(*s, [&](const Vector2d& x, const auto& u) { return (k == 0 ? 1 : x[k - 1]) * (own ? u[0] : exact.u(x[0], x[1])); });
    };
    for (int k = 0; k < 3; ++k) CHECK(std::abs(weighted(k, true)) < 1e-11);
    // The exact one less its projection on 1, x and y.
    Eigen::Matrix3d A;
    Eigen::Vector3d b;
    for (int i = 0; i < 3; ++i) {
      b[i] = weighted(i, false);
      for (int j = 0; j < 3; ++j) A(i, j) = test::integrate(*s, [&](const Vector2d& x, const auto&) { return (i == 0 ? 1 : x[i - 1]) * (j == 0 ? 1 : x[j - 1]); });
    }
    const Eigen::Vector3d motion = A.inverse() * b;
    Cubic normalised = exact;
    for (int i = 0; i < 3; ++i) normalised.c[i] -= motion[i];
    const auto off = test::error(*s, [&](double x, double y) { return normalised.values(x, y); });
    CHECK(off.deflection < 1e-10);
    CHECK(off.curvature < 1e-9);
  }
}

TEST_CASE("patch test: point supports hold what they are told to, and bear nothing where the rest is exact") {
  for (const Element element : kElements) {
    const Cubic& exact = exact_for(element);
    Plate p = plate_of(element);
    for (int side = 0; side < 4; ++side) {
      test::support(p, kParts[side], force(exact, side), moment(exact, side));
      load_corner(p, exact, side);
    }
    for (const Vector2d& x : {Vector2d(0.5, 0.4), Vector2d(1.3, 0.7), Vector2d(0.8, 1.1)})
      p.supports.push_back({x[0], x[1], {&laws::prescribed, exact.u(x[0], x[1])}});
    check(p, exact, 1e-9);
    const auto s = test::solved(p);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(point_reaction(*s, k)) < 1e-9);
  }
}
