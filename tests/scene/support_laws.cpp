// Laws of supports along the normal of a part: foundations, with closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/laws.hpp"
#include "base/error.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/programs/penalty.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/uzawa.hpp"
#include "solver/rows/uzawa_pdas.hpp"

using namespace dotyk;
using mesh::Point;
namespace laws = dotyk::problem::laws;
using test::Laws;

namespace {

/// A pressed block on a law, sliding at its sides of symmetry.
std::shared_ptr<scene::Scene> pressed(int dimension, mesh::Family family, const Laws& law, double pressure, int n = 3) {
  const auto block = test::block("block", dimension, family, n);
  test::symmetric(block);
  test::support(block, "bottom", law);
  test::press(block, "top", pressure);
  return scene::make_scene({block});
}

/// A block of sides b × 1 under a load whose resultant lies at x = 0.25 b, held along x at its left lower corner alone.
std::shared_ptr<scene::Scene> eccentric(double E, const Laws& law, double force, int n, double b = 2) {
  auto m = test::rectangle(mesh::Family::q1, n, 2);
  mesh::transform(m, [&](const Point& x) { return Point{b * x[0], x[1], 0}; });
  const auto block = test::body("block", std::move(m), E, 0);
  test::hold(*block, [](const Point& x) { return x[0] == 0 && x[1] == 0; });
  block->supports.back().components.front() = {true, false, false};
  test::support(block, "bottom", law);
  const double e = 0.25 * b;
  test::pull(block, "top", [=](const Point& x) { return Point{0, -force / b * (1 - 12 * e * (x[0] - b / 2) / (b * b)), 0}; });
  return scene::make_scene({block});
}

}  // namespace

TEST_CASE("a block pressed on a foundation sinks in by p/k, alike everywhere") {
  const double p = 2.5, k = 40, E = 210;
  for (const int dimension : {2, 3})
    for (const auto family : test::kAllFamilies)
      for (const Laws law : {Laws{&laws::one_sided_elastic, k}, Laws{&laws::elastic, k}, Laws{&laws::capped_elastic, k, 3.0},
                             Laws{&laws::breaking, k, 3.0}, Laws{&laws::unequal_elastic, k, 3 * k}}) {
        const auto s = test::solve(pressed(dimension, family, law, p));
        REQUIRE(s->result().converged);
        const auto r = s->support(test::part(s->scene().bodies[0], "bottom"));
        for (const scene::SupportNode& node : r.nodes) {
          CHECK(node.away == doctest::Approx(-p / k).epsilon(1e-11));
          CHECK(node.pressure == doctest::Approx(p).epsilon(1e-11));
          CHECK(node.status == (law.is(laws::capped_elastic) ? problem::Status::stick : problem::Status::closed));
          CHECK(std::abs(node.shear[0]) + std::abs(node.shear[1]) + std::abs(node.shear[2]) < 1e-11);
        }
        CHECK(r.area == doctest::Approx(1).epsilon(1e-12));
        CHECK(r.force[dimension - 1] == doctest::Approx(p).epsilon(1e-11));
        // ½ of the work of p on what it moves; plane strain is stiffer by 1/(1 − ν²).
        const double M = dimension == 2 ? E / (1 - 0.3 * 0.3) : E;
        CHECK(s->energy() == doctest::Approx(-0.5 * p * p * (1 / k + 1 / M)).epsilon(1e-11));
        CHECK(test::imbalance(*s, {"bottom", "left"}) < 1e-11);
      }
}

TEST_CASE("a block pulled off a foundation of two stiffnesses rises by p/k of the spring that pulls") {
  const double p = 2.5, k = 40;
  for (const int dimension : {2, 3})
    for (const auto family : test::kAllFamilies) {
      const auto s = test::solve(pressed(dimension, family, {&laws::unequal_elastic, 3 * k, k}, -p));
      for (const scene::SupportNode& node : s->support(test::part(s->scene().bodies[0], "bottom")).nodes) {
        CHECK(node.away == doctest::Approx(p / k).epsilon(1e-11));
        CHECK(node.pressure == doctest::Approx(-p).epsilon(1e-11));
        CHECK(node.status == problem::Status::closed);
      }
      CHECK(test::imbalance(*s, {"bottom", "left"}) < 1e-11);
    }
}

TEST_CASE("a foundation that pulls as well as it pushes is elastic, one that does not pull one-sided, one that hardly does nearly so") {
  const auto solved = [](const Laws& law) { return test::solve(eccentric(50, law, 1, 12)); };
  CHECK(test::distance(*solved({&laws::unequal_elastic, 20, 20}), *solved({&laws::elastic, 20})) < 1e-12);
  const auto one_sided = solved({&laws::one_sided_elastic, 20});
  CHECK(test::distance(*solved({&laws::unequal_elastic, 20, 0}), *one_sided) < 1e-12);
  const double near = test::distance(*solved({&laws::unequal_elastic, 20, 1e-3}), *one_sided);
  const double nearer = test::distance(*solved({&laws::unequal_elastic, 20, 1e-4}), *one_sided);
  CHECK(near / nearer == doctest::Approx(10).epsilon(0.05));  // the first order in k_pull
}

TEST_CASE("every method gives the same foundation") {
  for (const problem::LawSpec* kind : {&laws::one_sided_elastic, &laws::capped_elastic, &laws::one_sided_friction, &laws::signorini, &laws::unequal_elastic}) {
    Laws law{kind, 60, 1.9};
    if (kind == &laws::one_sided_friction) law.numbers[0] = 1.9;
    if (kind == &laws::unequal_elastic) law.numbers[1] = 5;
    const auto scene = eccentric(50, law, 1.2, 10);
    const auto exact = test::solve_by(scene, solver::Pdas{});
    CHECK(test::distance(*test::solve_by(scene, solver::Newton{}), *exact) < 1e-9);
    CHECK(test::distance(*test::solve_by(scene, solver::Proximal{}), *exact) < 1e-8);
    CHECK(test::distance(*test::solve_by(scene, test::patient(solver::Psor{})), *exact) < 1e-7);  // stops by the residual of λ
    for (auto method : {test::patient(solver::Uzawa{}), test::patient(solver::UzawaPdas{}), test::patient(solver::ProjectedCg{})})
      CHECK(test::distance(*test::solve_by(scene, method), *exact) < 1e-7);
    CHECK(test::distance(*test::solve(scene, false), *exact) < 1e-9);
    using Preconditioner = solver::Feti::Preconditioner;
    for (const auto preconditioner : {Preconditioner::none, Preconditioner::lumped, Preconditioner::dirichlet})
      for (const int count : {1, 5})
        for (const bool rows : {true, false})
          CHECK(test::distance(*test::solve_by(scene, test::feti(count, rows, preconditioner)), *exact) < 1e-7);
  }
}

TEST_CASE("methods for linear and unilateral laws alone give the same rigid base") {
  const auto block = test::block("block", 2, mesh::Family::p1, 4);
  test::support(block, "bottom", {&laws::signorini}, {&laws::elastic, 30});
  test::support(block, "left", {&laws::elastic, 20});
  test::pull(block, "top", [](const Point& x) { return Point{0.4, 4 - 9 * x[0], 0}; });
  const auto scene = scene::make_scene({block});
  const auto exact = test::solve_by(scene, solver::Pdas{});
  CHECK(exact->support(test::part(block, "bottom")).open > 0);
  CHECK(test::imbalance(*exact, {"bottom", "left"}) < 1e-11);
  CHECK(test::distance(*test::solve_by(scene, solver::ActiveSet{}), *exact) < 1e-9);
  CHECK(test::distance(*test::solve_by(scene, solver::InteriorPoint{}), *exact) < 1e-6);
  solver::Penalty penalty;
  penalty.factor = 1e6;
  CHECK(test::distance(*test::solve_by(scene, penalty), *exact) < 1e-4);  // never exact
}

TEST_CASE("a foundation without tension under a nearly rigid block: the triangle of pressure has length 3(b/2 - e)") {
  const double force = 3, k = 2, b = 2, length = 3 * (b / 2 - b / 4);
  const auto error = [&](int n) {
    const auto s = test::solve(eccentric(1e6, {&laws::one_sided_elastic, k}, force, n));
    REQUIRE(s->result().converged);
    double worst = 0;
    for (const scene::SupportNode& node : s->support(test::part(s->scene().bodies[0], "bottom")).nodes)
      worst = std::max(worst, std::abs(node.pressure - 2 * force / length * std::max(0.0, 1 - node.x[0] / length)));
    return worst;
  };
  const double coarse = error(16), fine = error(32);
  // The trapezoidal rule's error of the moment, h²; the triangle ends at a node of both meshes.
  CHECK(coarse < std::pow(b / 16 / length, 2) * 2 * force / length);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("stiffer foundations tend to a rigid base with 1/k") {
  const auto rigid = test::solve(eccentric(50, {&laws::signorini}, 1, 12));
  double last = 0;
  for (const double k : {1e5, 1e6, 1e7}) {
    const double d = test::distance(*test::solve(eccentric(50, {&laws::one_sided_elastic, k}, 1, 12)), *rigid);
    if (last > 0) CHECK(last / d == doctest::Approx(10).epsilon(0.02));
    last = d;
  }
}

TEST_CASE("a rigid base is contact with a rigid half-space without a gap") {
  for (const int dimension : {2, 3}) {
    const auto block = [&] {
      const auto b = test::block("block", dimension, mesh::Family::p1, 4);
      test::slide(b, "left");
      if (dimension == 3) test::slide(b, "front");
      test::pull(b, "top", [=](const Point& x) {
        Point t{0, 0, 0};
        t[dimension - 1] = 4 - 9 * x[0];
        return t;
      });
      return b;
    };
    const auto law = block(), met = block();
    test::support(law, "bottom", {&laws::signorini});
    auto with_contact = scene::make_scene({met});
    Point up{0, 0, 0};
    up[dimension - 1] = 1;
    const auto contact = scene::add_contact(*with_contact, test::part(met, "bottom"), contact::RigidPlane{{0, 0, 0}, up}, {}, false);
    const auto a = test::solve(scene::make_scene({law})), b = test::solve(with_contact);
    CHECK(test::distance(*a, *b) < 1e-12);
    const auto mine = a->support(test::part(law, "bottom"));
    const auto other = b->contact(*contact);
    CHECK(mine.open == other.open);
    CHECK(other.open > 0);
    CHECK(mine.max_pressure == doctest::Approx(other.max_pressure).epsilon(1e-12));
  }
}

TEST_CASE("prescribed values and loads of laws are displacements and pressures") {
  for (const auto& [law, tangential] : {std::pair{Laws{&laws::prescribed, 0.01}, Laws{&laws::prescribed, -0.02}},
                                        std::pair{Laws{&laws::load, 1.5}, Laws{&laws::load, 0.4}}}) {
    const auto mine = test::block("block", 2, mesh::Family::p1, 3), other = test::block("block", 2, mesh::Family::p1, 3);
    for (const auto& b : {mine, other}) test::fix(b, "top");
    test::support(mine, "bottom", law, tangential);
    auto bottom = test::part(other, "bottom");
    const Point value{tangential.numbers[0], law.numbers[0], 0};  // up is away from the support, x along the tangent
    if (law.is(laws::load))
      scene::load(bottom, [=](const Point&) { return value; });
    else
      scene::displace(bottom, {[=](const Point&) { return value[0]; }, [=](const Point&) { return value[1]; }, nullptr});
    const auto a = test::solve(scene::make_scene({mine})), b = test::solve(scene::make_scene({other}));
    CHECK(test::distance(*a, *b) < 1e-12);
    CHECK(a->energy() == doctest::Approx(b->energy()).epsilon(1e-12));
    const Point r = a->reaction(test::part(mine, "bottom")), s = b->reaction(test::part(other, "bottom"));
    for (int i = 0; i < 2; ++i) CHECK(r[i] == doctest::Approx(law.is(laws::load) ? value[i] : s[i]).epsilon(1e-11));
    CHECK(test::imbalance(*a, {"bottom", "top"}) < 1e-12);
  }
}

TEST_CASE("turning body, load and support together turns the solution") {
  const auto turned = [](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    auto m = test::rectangle(mesh::Family::p1, 4, 3);
    mesh::transform(m, [=](const Point& x) { return Point{c * x[0] - s * x[1], s * x[0] + c * x[1], 0}; });
    const auto block = test::body("block", std::move(m));
    test::support(block, "bottom", {&laws::one_sided_elastic, 30}, {&laws::capped_elastic, 20, 0.25});
    test::pull(block, "left", [=](const Point&) { return Point{0.2 * c, 0.2 * s, 0}; });
    test::press(block, "top", 1);
    return test::solve(scene::make_scene({block}));
  };
  const auto straight = turned(0), oblique = turned(0.4);
  CHECK(oblique->energy() == doctest::Approx(straight->energy()).epsilon(1e-11));
  const auto a = straight->support(test::part(straight->scene().bodies[0], "bottom"));
  const auto b = oblique->support(test::part(oblique->scene().bodies[0], "bottom"));
  for (std::size_t k = 0; k < a.nodes.size(); ++k) {
    CHECK(b.nodes[k].pressure == doctest::Approx(a.nodes[k].pressure).epsilon(1e-9));
    CHECK(b.nodes[k].away == doctest::Approx(a.nodes[k].away).epsilon(1e-9));
    CHECK(b.nodes[k].status == a.nodes[k].status);
    CHECK(b.nodes[k].tangential == a.nodes[k].tangential);
  }
}

TEST_CASE("a foundation carries what its law can, and a load beyond is refused with the motion it drives") {
  const auto refused = [](const Laws& law, double pressure, const char* motion) {
    CHECK_THROWS_WITH_AS(test::solve(pressed(2, mesh::Family::p1, law, pressure)), doctest::Contains(motion), InputError);
  };
  refused({&laws::one_sided_elastic, 10}, -1, "nothing stops 'block': translation along y");
  refused({&laws::signorini}, -1, "nothing stops 'block': translation along y");
  refused({&laws::capped_elastic, 10, 2}, 2.01, "nothing stops 'block': translation along -y");
  refused({&laws::capped_elastic, 10, 2}, -2.01, "nothing stops 'block': translation along y");
  refused({&laws::friction, 2}, -2.01, "nothing stops 'block': translation along y");
  refused({&laws::one_sided_friction, 2}, 2.01, "nothing stops 'block': translation along -y");
  refused({&laws::breaking, 10, 2}, 2.01, "after 4 nodes of breaking supports broke: not held: nothing stops 'block': translation along -y");
  CHECK(test::solve(pressed(2, mesh::Family::p1, {&laws::capped_elastic, 10, 2}, -1.99))->result().converged);
  CHECK(test::solve(pressed(2, mesh::Family::p1, {&laws::one_sided_friction, 2}, 1.99))->result().converged);
}
