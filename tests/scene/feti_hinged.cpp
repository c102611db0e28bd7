// Bodies in space hinged along an axis: supports leave each of them one rotation, and contact alone holds it.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "../support/feti.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

/// A body hinged along a line in the direction of y, above or at z = 0, and the same scene turned in space.
struct Shape {
  const char* name;
  mesh::Mesh mesh;
  double x, z;  ///< of the axis
};

/// Squares across y made nearly round, of radius 1 about (0, 1).
mesh::Mesh cylinder(mesh::Family family, int n) {
  mesh::Mesh m = test::box(family, 2 * n, n, 2 * n, {-1, 0, -1}, {1, 1, 1});
  mesh::transform(m, [](Point x) {
    const double square = std::max(std::abs(x[0]), std::abs(x[2])), circle = std::hypot(x[0], x[2]);
    const double factor = circle > 0 ? 0.3 + 0.7 * square / circle : 1;
    return Point{factor * x[0], x[1], 1 + factor * x[2]};
  });
  return m;
}

/// Hinged at an edge of its foot, on its surface half way up, and at the end of its arm.
std::vector<Shape> shapes(mesh::Family family) {
  const auto corner = [](const Point& x) { return x[0] < 0.5 || x[2] > 0.5; };
  return {{"box", test::box(family, 4, 3, 3), 0, 0},
          {"cylinder", cylinder(family, 2), -1, 1},
          {"L", mesh::keep(test::box(family, 4, 2, 4), corner, "inner"), 1, 1}};
}

Eigen::Matrix3d turn(bool turned) {
  if (!turned) return Eigen::Matrix3d::Identity();
  return (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-1.1, Eigen::Vector3d::UnitZ())).toRotationMatrix();
}

Point times(const Eigen::Matrix3d& R, const Point& x) {
  const Eigen::Vector3d y = R * Eigen::Vector3d(x[0], x[1], x[2]);
  return {y[0], y[1], y[2]};
}

/// Rᵀx.
Point back(const Eigen::Matrix3d& R, const Point& x) {
  const Eigen::Vector3d y = R.transpose() * Eigen::Vector3d(x[0], x[1], x[2]);
  return {y[0], y[1], y[2]};
}

std::shared_ptr<scene::Body> hinged(const Shape& shape, const Eigen::Matrix3d& R) {
  mesh::Mesh m = shape.mesh;
  mesh::transform(m, [&](const Point& x) { return times(R, x); });
  const auto b = test::body(shape.name, std::move(m));
  test::hold(*b, [&](const Point& x) {
    const Point at = back(R, x);
    return std::hypot(at[0] - shape.x, at[2] - shape.z) < 1e-9;
  });
  auto all = scene::chosen_part(b, "all", [](const Point&, const Point&) { return true; });
  scene::load(all, [&](const Point& x) {
    const Point at = back(R, x);
    return times(R, {0.2 * at[2], 0.3, -1 - 0.5 * at[1]});
  });
  return b;
}

/// The facets that look down, but for those that the axis touches.
scene::Part underside(const std::shared_ptr<scene::Body>& b, const Shape& shape, const Eigen::Matrix3d& R) {
  return scene::chosen_part(b, "underside", [&](const Point& x, const Point& n) {
    const Point at = back(R, x);
    return back(R, n)[2] < -0.5 && at[2] < 0.4 && std::hypot(at[0] - shape.x, at[2] - shape.z) > 0.3;
  });
}

void check(const scene::Solution& s, const scene::Solution& exact) {
  REQUIRE_MESSAGE(s.result().converged, s.result().reason);
  const auto &mine = s.result().state, &right = exact.result().state;
  CHECK((mine.lambda - right.lambda).norm() <= 1e-9 * right.lambda.norm());
  CHECK((mine.u.here() - right.u.here()).norm() <= 1e-9 * right.u.here().norm());
  CHECK(right.lambda.minCoeff() >= 0);
  for (std::size_t k = 0; k < s.scene().bodies.size(); ++k) {
    const auto left = test::imbalance(s, static_cast<int>(k));
    CHECK(left.resultant <= 1e-11);
    CHECK(left.nodal <= 3e-10);  // tol, 1e-11, times what stiffness makes of the disagreement of copies
  }
}

}  // namespace

TEST_CASE("a body hinged along an axis and held by contact with a plane: FETI against the direct method") {
  for (const auto family : test::kFamilies)
    for (const Shape& shape : shapes(family))
      for (const bool turned : {false, true}) {
        CAPTURE(shape.name);
        CAPTURE(turned);
        const auto R = turn(turned);
        const auto b = hinged(shape, R);
        const auto s = scene::make_scene({b});
        const contact::RigidShape plane = contact::RigidPlane{times(R, {0, 0, -1e-3}), times(R, {0, 0, 1})};
        scene::add_contact(*s, underside(b, shape, R), plane, {}, false);
        const auto exact = test::solve(s);
        REQUIRE(exact->result().converged);
        REQUIRE(exact->model().problem.blocks[0].kernel.cols() == 1);
        for (const bool rows : {true, false})
          for (const int count : {1, 3, 8}) {
            CAPTURE(rows);
            CAPTURE(count);
            const auto cut = test::solve_by(s, test::feti(count, rows));
            check(*cut, *exact);
            if (count == 1 && !rows) CHECK(cut->result().feti->kernel == 1);
          }
      }
}

TEST_CASE("two hinged bodies, one on the other and that on a plane") {
  const auto family = mesh::Family::q1;
  const Shape upper{"upper", test::box(family, 4, 3, 3), 0, 0}, lower{"lower", test::box(family, 4, 3, 3, {0, 0, -1}, {1, 1, 0}), 1, -1};
  for (const bool turned : {false, true}) {
    CAPTURE(turned);
    const auto R = turn(turned);
    const auto above = hinged(upper, R), below = hinged(lower, R);
    const auto top = scene::chosen_part(below, "top", [&](const Point& x, const Point& n) {
      return back(R, n)[2] > 0.5 && back(R, x)[0] > 0.3;
    });
    const auto s = scene::make_scene({above, below});
    scene::add_contact(*s, underside(above, upper, R), top, {});
    const contact::RigidShape plane = contact::RigidPlane{times(R, {0, 0, -1}), times(R, {0, 0, 1})};
    scene::add_contact(*s, underside(below, lower, R), plane, {}, false);
    const auto exact = test::solve(s);
    REQUIRE(exact->result().converged);
    for (const auto& block : exact->model().problem.blocks) REQUIRE(block.kernel.cols() == 1);
    for (const bool rows : {true, false})
      for (const int count : {2, 9}) {
        CAPTURE(rows);
        CAPTURE(count);
        check(*test::solve_by(s, test::feti(count, rows)), *exact);
      }
  }
}
