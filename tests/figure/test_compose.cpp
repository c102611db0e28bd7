// From a solution to what its picture shows.
#include <doctest/doctest.h>

#include <cmath>

#include "elasticity/material.hpp"
#include "figure/compose/compose.hpp"
#include "mesh/generators.hpp"
#include "solver/rows/psor.hpp"

using namespace dotyk;

namespace {

std::shared_ptr<scene::Body> block(const std::string& name, double low) {
  const double from[2] = {0, low}, to[2] = {1, low + 1};
  const int cells[2] = {2, 2};
  const mesh::Grading even[2];
  return scene::make_body(name, std::make_shared<mesh::Mesh>(mesh::rectangle(from, to, cells, mesh::Family::q1, even)),
                          elasticity::MaterialField(elasticity::isotropic(1000, 0, 2, elasticity::Plane::strain)), {});
}

/// Two blocks `gap` apart, the upper one moved onto the lower and 0.0019 further.
std::shared_ptr<scene::Solution> pressed(double gap, const solver::Method& method = {}) {
  auto lower = block("lower", 0), upper = block("upper", 1 + gap);
  auto held = scene::named_part(lower, "bottom"), moved = scene::named_part(upper, "top");
  scene::fix(held, {true, true, true});
  scene::displace(moved, {[](const mesh::Point&) { return 0.0; }, [gap](const mesh::Point&) { return -gap - 0.0019; }, {}});
  const auto s = scene::make_scene({lower, upper});
  scene::add_contact(*s, scene::named_part(upper, "bottom"), scene::named_part(lower, "top"), {}, {}, true);
  Monitor quiet;
  return scene::solve(s, method, {}, quiet);
}

double factor_across(double gap) { return figure::visible_deformation(*pressed(gap)); }

}  // namespace

TEST_CASE("the deformation is magnified until it is seen, but bodies that crossed a gap are not drawn into each other") {
  CHECK(factor_across(0) == 100);     // 0.1 × 2 / 0.0019, rounded
  CHECK(factor_across(0.001) == 20);  // 19 gaps of overlap, 1 % of the size
  CHECK(factor_across(0.05) == 1);
  CHECK(factor_across(-0.001) == 20);  // 20 interferences drawn apart, 1 % of the size
}

namespace {

/// How far the point is from the obstacle's line.
double off(const figure::RigidPicture& line, const figure::Vec3& x) {
  double least = INFINITY;
  for (std::size_t i = 0; i + 5 < line.points.size(); i += 3) {
    const double* p = &line.points[i];
    const double dx = p[3] - p[0], dy = p[4] - p[1], length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp(((x[0] - p[0]) * dx + (x[1] - p[1]) * dy) / length, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(x[0] - p[0] - t * dx, x[1] - p[1] - t * dy));
  }
  return least;
}

figure::Vec3 drawn(const figure::ContactNode& node, double factor) {
  return {node.position[0] + factor * node.displacement[0], node.position[1] + factor * node.displacement[1], 0};
}

/// A disc of radius 1 over the plane y = −0.01, which moves up by 0.03 and to the right by 0.005.
std::shared_ptr<scene::Solution> pressed_disc() {
  const double centre[2] = {0, 1};
  auto disc = scene::make_body("disc", std::make_shared<mesh::Mesh>(mesh::disc(centre, 1, 20, mesh::Family::p1)),
                               elasticity::MaterialField(elasticity::isotropic(1000, 0.3, 2, elasticity::Plane::strain)), {});
  auto top = scene::named_part(disc, "boundary");
  std::erase_if(top.facets, [&](mesh::Facet f) { return disc->mesh->facet_centre(f)[1] < 1.7; });
  scene::fix(top, {true, true, true});
  const auto s = scene::make_scene({disc});
  const auto contact = scene::add_contact(*s, scene::named_part(disc, "boundary"), contact::RigidPlane{{0, -0.01, 0}, {0, 1, 0}}, {}, false);
  scene::Step step;
  step.move = {{contact, {0.005, 0.03, 0}}};
  Monitor quiet;
  return scene::solve(s, {}, {}, quiet, {step});
}

}  // namespace

TEST_CASE("a rigid plane is drawn where it has been moved to, and closed nodes lie on it at any magnification") {
  const auto s = pressed_disc();
  for (const double factor : {1.0, 3.0, 10.0}) {
    CAPTURE(factor);
    figure::SceneOptions options;
    options.deform = factor;
    const figure::ScenePicture picture = figure::compose(*s, options);
    REQUIRE(picture.obstacles.size() == 1);
    const figure::RigidPicture& plane = picture.obstacles[0];
    int closed = 0;
    double lowest = INFINITY, highest = -INFINITY;
    for (const figure::ContactNode& node : picture.contacts[0].nodes) {
      const figure::Vec3 x = drawn(node, factor);
      if (node.status == figure::Status::open) {
        if (node.normal[1] < 0 && x[1] < 0.3) CHECK(off(plane, x) > 1e-6);
        continue;
      }
      ++closed;
      CHECK(off(plane, x) < 0.006);  // the way along it, at its size
    }
    CHECK(closed >= 3);
    for (std::size_t i = 1; i < plane.points.size(); i += 3) lowest = std::min(lowest, plane.points[i]), highest = std::max(highest, plane.points[i]);
    if (factor == 1) CHECK(lowest == doctest::Approx(0.02));
    if (factor == 1) CHECK(highest == doctest::Approx(0.02));
    // No hooks: it gives way under the contact by no more than displacements do, and goes on straight.
    CHECK(highest - lowest <= factor * 0.03);
    CHECK(plane.points[1] == doctest::Approx(plane.points[plane.points.size() - 2]).epsilon(1e-3));
    CHECK(plane.points[1] == doctest::Approx(plane.points[7]).epsilon(1e-3));
  }
}

TEST_CASE("an obstacle that nothing touches stays where it is") {
  auto body = block("block", 0);
  auto moved = scene::named_part(body, "top");
  scene::displace(moved, {[](const mesh::Point&) { return 0.2; }, [](const mesh::Point&) { return 0.1; }, {}});
  const auto s = scene::make_scene({body});
  scene::add_contact(*s, scene::named_part(body, "bottom"), contact::RigidGap{{0, -1, 0}, [](const mesh::Point&) { return 0.0; }}, {}, false);
  Monitor quiet;
  figure::SceneOptions options;
  options.deform = 5;
  const figure::ScenePicture picture = figure::compose(*scene::solve(s, {}, {}, quiet), options);
  REQUIRE(picture.obstacles.size() == 1);
  CHECK(picture.obstacles[0].points == std::vector<double>{0, 0, 0, 0.5, 0, 0, 1, 0, 0});
}

TEST_CASE("the picture of a solution that has not converged says so") {
  solver::Psor one_step;
  one_step.max_iterations = 1;
  const auto poor = pressed(0, one_step);
  REQUIRE_FALSE(poor->result().converged);
  CHECK(figure::compose(*poor, {}).caption == "not converged: no convergence within 1 iterations");
  CHECK(figure::compose(*pressed(0), {}).caption.empty());
}
