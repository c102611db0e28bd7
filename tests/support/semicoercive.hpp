#pragma once

#include <cmath>

#include "scenes.hpp"

namespace dotyk::test {

/// The semicoercive cases of TR965 1.2: the lower body is fixed, the upper one held by its side along
/// x₂ (slide) and by contact.
struct Case {
  const char* name;
  std::shared_ptr<scene::Scene> scene;
  std::size_t screws;  ///< how many are needed
};

inline mesh::Mesh shaped(int dim, int n, double bottom, const std::function<double(double, double)>& bend) {
  mesh::Mesh m = unit(dim, mesh::Family::q1, n);
  mesh::transform(m, [&](Point x) {
    x[dim - 1] += bottom + bend(x[0], dim == 3 ? x[1] : 0);
    return x;
  });
  return m;
}

inline Case make_case(const char* name, int dim, std::size_t screws, const std::function<double(double, double)>& bend,
          const elasticity::VectorField& traction) {
  const int n = dim == 2 ? 8 : 4;
  const auto lower = body("lower", shaped(dim, n, -1, bend), 200),
             upper = body("upper", shaped(dim, n, 0, bend), 700);
  fix(lower, "bottom");
  // In the plane the upper body may only rise; in space it may move and turn in the x₁x₃ plane.
  slide(upper, dim == 2 ? "left" : "front");
  pull(upper, "top", traction);
  auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, part(upper, "bottom"), part(lower, "top"), {});
  return {name, scene, screws};
}

inline std::vector<Case> semicoercive_cases() {
  const auto down2 = [](const Point& x) { return Point{0, -1 - x[0], 0}; };
  const auto down3 = [](const Point& x) { return Point{0, 0, -1 - x[1]}; };  // its middle is at x₁ = ½
  const auto flat = [](double, double) { return 0.0; };
  const auto bowl = [](double x, double) { return 0.3 * (x - 0.4) * (x - 0.4); };
  const auto groove = [](double x, double y) { return std::abs(x - 0.5) * (0.6 + 0.1 * y); };
  // A cylinder about the axis x₁ = ½, x₃ = 2, along x₂, and the same with a ripple of 1 %.
  const auto cylinder = [](double x, double) { return 2 - std::sqrt(4 - (x - 0.5) * (x - 0.5)); };
  const auto almost = [=](double x, double y) { return cylinder(x, y) + 0.01 * std::sin(3 * x + 1); };
  return {make_case("plane, flat", 2, 1, flat, down2), make_case("plane, curved", 2, 1, bowl, down2),
          make_case("space, planar contact", 3, 2, flat, down3), make_case("space, a groove", 3, 3, groove, down3),
          make_case("space, almost a cylinder", 3, 3, almost, down3)};
}

}  // namespace dotyk::test
