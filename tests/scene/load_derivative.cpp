// Exact derivatives of loads and forces by moving nodes against central differences of moved scenes, over steps from 1e-2 to 1e-11: the
// error falls as h² until rounding, some 1e-16/h, takes over; where both are alike, about h = 1e-5, 1e-11 to 1e-10 are left, so that
// 1e-9 is asked for.
#include "scene/result/load_derivative.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../support/scenes.hpp"
#include "base/error.hpp"
#include "scene/model/moved.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

std::vector<double> random_field(const scene::Body& b, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> out(b.mesh->coordinates.size());
  for (double& v : out) v = number(engine);
  return out;
}

std::vector<double> field(const scene::Body& b, const std::function<Point(const Point&)>& of) {
  std::vector<double> out;
  for (int n = 0; n < b.mesh->node_count(); ++n) {
    const Point v = of(b.mesh->point(n));
    out.insert(out.end(), v.begin(), v.begin() + b.dimension());
  }
  return out;
}

std::shared_ptr<scene::Body> after(const std::shared_ptr<scene::Body>& b, const std::vector<double>& V, double h) {
  std::vector<double> x = b->mesh->coordinates;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += h * V[k];
  return scene::moved(*scene::make_scene({b}), {x})->bodies[0];
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// The errors of central differences of `of`(body) along V against `exact`, relative.
template <class Of>
std::vector<double> errors(const std::shared_ptr<scene::Body>& b, const std::vector<double>& V, const std::vector<double>& exact, const Of& of) {
  std::vector<double> out;
  for (int k = 2; k <= 11; ++k) {
    const double h = std::pow(10, -k);  // V is of size 1, cells of 0.3: more would invert them
    const auto above = of(*after(b, V, h)), below = of(*after(b, V, -h));
    std::vector<double> apart(exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) apart[i] = (above[i] - below[i]) / (2 * h) - exact[i];
    out.push_back(norm(apart) / norm(exact));
  }
  return out;
}

double least(const std::vector<double>& e) { return *std::min_element(e.begin(), e.end()); }

void check_v_shape(const std::vector<double>& e) {
  CHECK(e[1] / e[0] == doctest::Approx(0.01).epsilon(0.1));  // order 2
  CHECK(least(e) < 1e-9);
  CHECK(e.back() > 1e-8);  // rounding
}

/// A bent block, its boundary curved.
std::shared_ptr<scene::Body> bent(int dimension, mesh::Family family) {
  mesh::Mesh m = test::unit(dimension, family, 3);
  mesh::transform(m, [&](const Point& x) {
    return Point{x[0] + 0.08 * std::sin(3 * x[1] + x[2]), x[1] + 0.05 * std::cos(2 * x[0]), dimension == 2 ? 0 : x[2] + 0.06 * x[0] * x[1]};
  });
  return test::body("bent", std::move(m));
}

Point varying(const Point& x) { return {1 + x[0], x[0] * x[1] - 2, 3 - x[1]}; }

scene::Loading loading() {
  scene::Loading l;
  l.all = 0.7;
  l.factor["pull"] = 2;
  return l;
}

std::vector<double> loads(const scene::Body& b) { return loading().applied_to(b).force; }

void refused(const scene::Scene& s, const std::vector<std::vector<double>>& V, const char* why) {
  CHECK_THROWS_WITH_AS(scene::require_differentiable(s, V), doctest::Contains(why), InputError);
}

}  // namespace

TEST_CASE("the derivative of each kind of load, in its case, all elements") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (int kind = 0; kind < 3; ++kind) {
        CAPTURE(dim);
        CAPTURE(kind);
        const auto b = bent(dim, family);
        auto all = scene::chosen_part(b, "all", [](const Point&, const Point&) { return true; });
        if (kind == 0) scene::load_volume(*b, varying);
        if (kind == 1) scene::load(all, varying, "pull");
        if (kind == 2) scene::pressure(all, [](const Point& x) { return 1 + x[0] * x[1]; }, "pull");
        const auto V = random_field(*b, 7);
        const auto e = errors(b, V, scene::load_derivative(*b, loading(), V), loads);
        if (kind == 1)
          check_v_shape(e);
        else
          CHECK(least(e) < 1e-9);  // polynomials of the step of degree dim or dim − 1: in the plane no order to see
      }
}

TEST_CASE("the derivative of a sum of loads of several cases, under their factors") {
  const auto b = bent(3, mesh::Family::q1);
  auto right = test::part(b, "right"), top = test::part(b, "top");
  scene::load_volume(*b, [](const Point&) { return Point{0, 0, -1}; });
  scene::load(right, varying);
  scene::pressure(top, [](const Point& x) { return 1 + x[0]; }, "pull");
  const auto V = random_field(*b, 8);
  check_v_shape(errors(b, V, scene::load_derivative(*b, loading(), V), loads));
}

TEST_CASE("constant pressure all around has no resultant, however nodes move") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto b = bent(dim, family);
      auto all = scene::chosen_part(b, "all", [](const Point&, const Point&) { return true; });
      scene::pressure(all, [](const Point&) { return 1.0; });
      const auto d = scene::load_derivative(*b, {}, random_field(*b, 9));
      for (int i = 0; i < dim; ++i) {
        double sum = 0;
        for (std::size_t k = i; k < d.size(); k += dim) sum += d[k];
        CHECK(std::abs(sum) < 1e-13 * norm(d));
      }
    }
}

TEST_CASE("the derivative of internal forces with springs, all elements; of the springs alone, too") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dim);
      const auto b = bent(dim, family);
      auto right = test::part(b, "right");
      scene::spring(right, {[](const Point& x) { return 300 + x[1]; }, [](const Point&) { return 200.0; }, nullptr});
      const auto u = random_field(*b, 10), V = random_field(*b, 11);
      const auto force = [&](const scene::Body& at) { return elasticity::internal_force(*at.mesh, at.material, at.facet_springs(), u); };
      check_v_shape(errors(b, V, scene::internal_force_derivative(*b, u, V), force));
      const auto of_springs = [&](const scene::Body& at) {
        auto sum = force(at);
        const auto cells = elasticity::internal_force(*at.mesh, at.material, {}, u);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] -= cells[k];
        return sum;
      };
      auto springs = scene::internal_force_derivative(*b, u, V);
      scene::Body bare = *b;
      bare.springs.clear();
      const auto cells = scene::internal_force_derivative(bare, u, V);
      for (std::size_t k = 0; k < springs.size(); ++k) springs[k] -= cells[k];
      CHECK(least(errors(b, V, springs, of_springs)) < 1e-8);  // the difference of forces some ten times as great
    }
}

TEST_CASE("a slide's part may move along itself and as a whole along its normal, not turn") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dim);
      const auto b = test::block("b", dim, family, 3);
      test::slide(b, "left");
      const auto s = scene::make_scene({b});
      const auto along = field(*b, [](const Point& x) { return Point{x[0], std::sin(x[1]), x[1] * x[2]}; });
      const auto whole = field(*b, [](const Point& x) { return Point{1 + x[0], 0, 0}; });
      CHECK_NOTHROW(scene::require_differentiable(*s, {along}));
      CHECK_NOTHROW(scene::require_differentiable(*s, {whole}));
      CHECK_NOTHROW(scene::require_differentiable(*s, {{}}));
      refused(*s, {field(*b, [](const Point& x) { return Point{x[1] * (1 - x[0]), 0, 0}; })}, "'b' left slides, and its nodes move so that its normal turns at (0, ");
      refused(*s, {{1, 2}}, "velocities are given for them");
      refused(*s, {}, "the scene has 1 bodies; velocities are given for 0");
    }
}

TEST_CASE("a slide on a circle may grow with it, not become an ellipse") {
  const auto disc = test::body("disc", test::disc(mesh::Family::q1, 4));
  test::slide(disc, "boundary");
  const auto s = scene::make_scene({disc});
  CHECK_NOTHROW(scene::require_differentiable(*s, {disc->mesh->coordinates}));
  refused(*s, {field(*disc, [](const Point& x) { return Point{x[0], 0, 0}; })}, "'disc' boundary slides");
}

TEST_CASE("supports by laws and rigid gaps must rest") {
  const auto b = test::block("b", 2, mesh::Family::p1, 3);
  auto right = test::part(b, "right");
  scene::support(right, problem::LawChoice{&problem::laws::elastic, 10}, {});
  const auto s = scene::make_scene({b});
  scene::add_contact(*s, test::part(b, "top"), contact::RigidGap{{0, 1, 0}, [](const Point&) { return 0.1; }}, {}, false);
  CHECK_NOTHROW(scene::require_differentiable(*s, {field(*b, [](const Point& x) { return Point{0, (1 - x[0]) * (1 - x[1]), 0}; })}));
  refused(*s, {field(*b, [](const Point& x) { return Point{x[0] * (1 - x[1]), 0, 0}; })}, "'b' right: its support by laws has no derivative; keep its nodes");
  refused(*s, {field(*b, [](const Point& x) { return Point{0, (1 - x[0]) * x[1], 0}; })}, "'b' top: its contact with a rigid gap");
}
