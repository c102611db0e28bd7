// From a solution to what its picture shows.
#include <doctest/doctest.h>

#include "elasticity/material.hpp"
#include "figure/compose.hpp"
#include "mesh/generators.hpp"
#include "solver/psor.hpp"

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
  scene::add_contact(*s, scene::named_part(upper, "bottom"), scene::named_part(lower, "top"), {});
  Monitor quiet;
  return scene::solve(s, method, {}, quiet);
}

double factor_across(double gap) { return figure::visible_deformation(*pressed(gap)); }

}  // namespace

TEST_CASE("the deformation is magnified until it is seen, but bodies that crossed a gap are not drawn into each other") {
  CHECK(factor_across(0) == 100);     // 0.1 × 2 / 0.0019, rounded
  CHECK(factor_across(0.001) == 20);  // 19 gaps of overlap, 1 % of the size
  CHECK(factor_across(0.05) == 1);
}

TEST_CASE("the picture of a solution that has not converged says so") {
  solver::Psor one_step;
  one_step.max_iterations = 1;
  const auto poor = pressed(0, one_step);
  REQUIRE_FALSE(poor->result().converged);
  CHECK(figure::compose(*poor, {}).caption == "not converged: no convergence within 1 iterations");
  CHECK(figure::compose(*pressed(0), {}).caption.empty());
}
