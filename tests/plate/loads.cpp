#include <doctest/doctest.h>

#include "../support/plates.hpp"

using namespace dotyk;
using namespace dotyk::plate;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;

TEST_CASE("a line load is the limit of its point loads, wherever the line runs") {
  for (const Element element : kElements) {
    test::Mesh m = test::rectangle(test::Family::p1, 7, 7);
    test::distort(m, 0.06);
    Plate p = test::plate_on(m, element);
    test::support(p, "", kHeld, kFree);
    for (const auto& [ax, ay, bx, by] : {std::array{0.1, 0.2, 0.9, 0.7}, {0.0, 0.0, 1.0, 1.0}, {0.5, 0.0, 0.5, 1.0}, {0.3, 0.31, 0.32, 0.3}}) {
      Plate line = p, points = p;
      line.line_loads = {{{ax, ay}, {bx, by}, -2}};
      // Of n points by the midpoint rule: to n⁻² where the deflection is smooth, to n⁻¹ of its jumps where it has any (Morley's).
      constexpr int n = 4000;
      const double length = std::hypot(bx - ax, by - ay);
      for (int i = 0; i < n; ++i) points.point_loads.push_back({ax + (bx - ax) * (i + 0.5) / n, ay + (by - ay) * (i + 0.5) / n, -2 * length / n});
      const algebra::Vector a = test::solved(line)->freedoms(), b = test::solved(points)->freedoms();
      CHECK((a - b).norm() < (element == Element::morley ? 1e-4 : 1e-6) * a.norm());
    }
  }
}

TEST_CASE("loads bear on the plate with their whole forces and moments") {
  for (const Element element : kElements) {
    test::Mesh m = test::rectangle(test::Family::p1, 5, 4, -1, 0, 2, 1.5);
    Plate p = test::plate_on(m, element);
    p.f_of = [](double x, double y) { return 1 + x - 2 * y + x * y; };
    p.point_loads = {{0.31, 0.77, 2.5}, {2, 1.5, -1}};
    p.line_loads = {{{-1, 0.2}, {1.3, 1.1}, 0.7}};
    test::support(p, "left", {&laws::load, 0.4}, {&laws::load, -0.3});
    const Model model = build(p);
    const Eigen::VectorXd resultants = model.space.motions().transpose() * model.load;
    const Eigen::Vector2d c = model.space.centre();
    const double unit = model.space.unit, line = 0.7 * std::hypot(2.3, 0.9);
    // ∫ f, ∫ f x and ∫ f y over [−1, 2] × [0, 1.5] of each monomial: x, y means ½ and ¾, of squares 1 and ¾.
    const double area = 4.5, F = area * (1 + 0.5 - 1.5 + 0.375), Fx = area * (0.5 + 1 - 0.75 + 0.75), Fy = area * (0.75 + 0.375 - 1.5 + 0.375);
    const double force = F + 2.5 - 1 + line + 0.4 * 1.5;
    const double along_x = Fx + 2.5 * 0.31 - 2 + line * 0.15 - 0.4 * 1.5 + 0.3 * 1.5;  // the moment works on −∂x u at the left edge
    const double along_y = Fy + 2.5 * 0.77 - 1.5 + line * 0.65 + 0.4 * 1.5 * 0.75;
    CHECK(resultants[0] == doctest::Approx(force).epsilon(1e-12));
    CHECK(resultants[1] == doctest::Approx((along_x - c[0] * force) / unit).epsilon(1e-12));
    CHECK(resultants[2] == doctest::Approx((along_y - c[1] * force) / unit).epsilon(1e-12));
  }
}
