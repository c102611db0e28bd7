// The derivative of a solution's energy, without u' and λ', against central differences of scenes solved again; weights of
// contact rows, too.
#include "shape/derivative/quantity.hpp"

#include "base/error.hpp"
#include "differences.hpp"
#include "shape/derivative/boundary_motion.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

namespace {

test::ScenePtr blocks(int dimension, const scene::GivenLaw& friction) {
  const auto lower = test::block("lower", dimension, Family::q1, 4, 0, 1000), upper = test::block("upper", dimension, Family::q1, 4, 1, 600);
  test::fix(lower, "bottom");
  test::springs(upper, "right", {30, dimension == 3 ? 25.0 : 0.0, 0});
  auto top = test::part(upper, "top");
  std::array<elasticity::ScalarField, 3> down;
  down[dimension - 1] = [](const Point& x) { return -0.01 - 0.01 * x[0]; };
  scene::displace(top, down);
  test::press(upper, "left", 3);
  const auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), [](const Point& x) { return 0.01 * x[0]; }, friction, true);
  return scene;
}

/// Absolute.
double least_error(const scene::Scene& scene, const test::Velocities& V, double exact, const std::function<double(const scene::Solution&)>& of) {
  double best = INFINITY;
  for (int k = 2; k <= 7; ++k) {
    const double h = std::pow(10, -k);
    best = std::min(best, std::abs((of(*test::solved_at(scene, V, h)) - of(*test::solved_at(scene, V, -h))) / (2 * h) - exact));
  }
  return best;
}

scene::GivenLaw given() {
  return {problem::laws::friction, [](const Point& x) { return 0.3 + 0.5 * x[0]; }};
}

}  // namespace

TEST_CASE("the energy's derivative, with springs, given displacements and given friction") {
  for (const int dimension : {2, 3})
    for (const auto& friction : {scene::GivenLaw{}, given()}) {
      const auto scene = blocks(dimension, friction);
      const auto V = test::velocities(*scene, [=, waves = test::waves(0.02)](int b, const Point& x) {
        Point v = waves(b, x);
        if (dimension == 3) v[2] *= (x[2] - 1) * (x[2] - 1);
        return v;
      });
      const auto solution = test::solved(scene);
      const double exact = shape::energy_derivative(*solution, V);
      CHECK(least_error(*scene, V, exact, [](const scene::Solution& s) { return s.energy() + s.friction_energy(); }) < 1e-9 * std::abs(solution->energy()));
    }
}

TEST_CASE("Coulomb friction has no least energy; what rests changes none") {
  const auto scene = blocks(2, {});
  CHECK_THROWS_WITH_AS(shape::energy_derivative(*test::solved(blocks(2, {problem::laws::coulomb, [](const Point&) { return 0.3; }})),
                                                test::velocities(*scene, test::waves(0.02))),
                       doctest::Contains("has Coulomb friction"), InputError);
  CHECK(shape::energy_derivative(*test::solved(scene), {{}, {}}) == 0);
}

TEST_CASE("weights of contact rows, against a rigid shape and between parts that overhang") {
  const auto lower = test::body("lower", test::rectangle(Family::q1, 6, 3, 0, 0, 1.5, 0.75)), upper = test::block("upper", 2, Family::q1, 4, 0.75);
  test::fix(lower, "bottom");
  test::fix(upper, "top");
  const auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(lower, "top"), test::part(upper, "bottom"), {}, {}, true);
  scene::add_contact(*scene, test::part(lower, "right"), contact::RigidPlane{{1.6, 0, 0}, {-1, 0, 0}}, {}, true);
  const auto V = test::velocities(*scene, test::waves(0.02));
  const auto solution = test::solved(scene);
  for (int c = 0; c < 2; ++c) {
    const auto exact = shape::weight_changes(*solution, c, V);
    const auto& rows = scene->contacts[static_cast<std::size_t>(c)]->rows;
    REQUIRE(exact.size() == rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      CHECK(least_error(*scene, V, exact[k], [&](const scene::Solution& s) { return s.scene().contacts[static_cast<std::size_t>(c)]->rows[k].weight; }) < 1e-8 * std::abs(exact[k]));
  }
}
