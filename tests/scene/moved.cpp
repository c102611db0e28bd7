// A scene whose nodes have moved against one set up there: all data constant, so that the two are the same to the last bit.
#include "scene/model/moved.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;
using problem::LawChoice;
using Map = std::function<Point(const Point&)>;

namespace {

Point rest(const Point& x) { return x; }

/// Keeps x = 0 and, in space, y = 0 straight.
Map bend(int dimension) {
  return [=](const Point& x) {
    if (dimension == 2) return Point{x[0] * (1 + 0.07 * std::sin(2 * x[1])), x[1] + 0.06 * std::cos(2 * x[0]), 0};
    return Point{x[0] * (1 + 0.07 * std::sin(2 * x[2] + x[1])), x[1] * (1 + 0.05 * std::cos(x[0])), x[2] + 0.06 * std::cos(2 * x[0]) * (1 + 0.5 * x[1])};
  };
}

std::shared_ptr<scene::Body> block(const std::string& name, int dimension, mesh::Family family, double lift, const Map& map) {
  mesh::Mesh m = test::unit(dimension, family, 3);
  mesh::transform(m, [&](Point x) { return x[dimension - 1] += lift, map(x); });
  return test::body(name, std::move(m));
}

elasticity::ScalarField constant(double value) {
  return [=](const Point&) { return value; };
}

/// Two blocks in contact with friction, a plane and a ball beside them, and every support and load.
std::shared_ptr<scene::Scene> setting(int dimension, mesh::Family family, const Map& map,
                                      contact::Multipliers multipliers = contact::Multipliers::nodal) {
  const auto lower = block("lower", dimension, family, 0, map), upper = block("upper", dimension, family, 1, map);
  const auto up = [=](double v) { return dimension == 2 ? Point{0.1, v, 0} : Point{0.1, 0.2, v}; };
  test::fix(lower, "bottom");
  test::symmetric(lower), test::symmetric(upper);
  scene::load_volume(*lower, [=](const Point&) { return up(-1); });
  auto top = test::part(upper, "top"), right = test::part(upper, "right"), side = test::part(lower, "right");
  scene::load(top, [=](const Point&) { return up(-2); }, "press");
  scene::pressure(top, constant(0.5));
  scene::pressure(right, constant(0.3), "press");
  std::array<elasticity::ScalarField, 3> given;
  given[dimension - 1] = constant(0.01);
  scene::displace(right, given, "press");
  test::springs(upper, "right", {3, 4, 5});
  scene::support(side, problem::LawChoice{&problem::laws::breaking, 10, 2}, problem::LawChoice{&problem::laws::friction, 0.2});
  const auto scene = scene::make_scene({lower, upper});
  scene::Discretisation discretisation;
  discretisation.multipliers = multipliers;
  scene::add_contact(*scene, test::part(lower, "top"), test::part(upper, "bottom"), constant(0.01),
                     {problem::laws::friction, constant(0.4)}, false, discretisation);
  scene::add_contact(*scene, test::part(lower, "right"), contact::RigidPlane{{1.5, 0, 0}, {-1, 0, 0}}, constant(-0.02), false);
  Point beside{4, 0.5, 0.5};  // so that rows have the line to its centre: else their frames are those of the part before it was bent
  beside[dimension - 1] = 2.6;
  scene::add_contact(*scene, test::part(upper, "top"), contact::RigidBall{beside, 0.3}, {}, false,
                     {problem::laws::coulomb, constant(0.3)});
  return scene;
}

std::vector<double> points(const scene::Body& body, const Map& map) {
  mesh::Mesh m = *body.mesh;
  for (int n = 0; n < m.node_count(); ++n) {
    const Point to = map(m.point(n));
    std::copy_n(to.begin(), m.dimension(), m.coordinates.begin() + static_cast<std::ptrdiff_t>(n) * m.dimension());
  }
  return m.coordinates;
}

std::vector<std::vector<double>> points(const scene::Scene& scene, const Map& map) {
  std::vector<std::vector<double>> all;
  for (const auto& body : scene.bodies) all.push_back(points(*body, map));
  return all;
}

scene::Model build(const scene::Scene& scene, double press = 1) {
  Monitor quiet;
  problem::Clock clock;
  scene::Loading loading;
  loading.factor["press"] = press;
  return scene::build(scene, clock, quiet, loading);
}

void check_same(const scene::Scene& a, const scene::Scene& b) {
  REQUIRE(a.contacts.size() == b.contacts.size());
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    const scene::Contact &one = *a.contacts[c], &other = *b.contacts[c];
    REQUIRE(one.rows.size() == other.rows.size());
    CHECK(one.tangential == other.tangential);
    for (std::size_t k = 0; k < one.rows.size(); ++k) {
      CHECK(one.rows[k].node == other.rows[k].node);
      CHECK(one.rows[k].partners == other.rows[k].partners);
      CHECK(one.rows[k].normal == other.rows[k].normal);
      CHECK(one.rows[k].gap == other.rows[k].gap);
      CHECK(one.rows[k].added == other.rows[k].added);
      CHECK(one.rows[k].weight == other.rows[k].weight);
    }
  }
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    const scene::Body &one = *a.bodies[k], &other = *b.bodies[k];
    for (std::size_t s = 0; s < one.supports.size(); ++s) CHECK(one.supports[s].normals == other.supports[s].normals);
    for (std::size_t s = 0; s < one.slides.size(); ++s) CHECK(one.slides[s].normal == other.slides[s].normal);
    for (std::size_t s = 0; s < one.laws.size(); ++s)
      for (std::size_t i = 0; i < one.laws[s].nodes.size(); ++i) {
        CHECK(one.laws[s].nodes[i].normal == other.laws[s].nodes[i].normal);
        CHECK(one.laws[s].nodes[i].weight == other.laws[s].nodes[i].weight);
      }
  }
  const scene::Model left = build(a, 0.7), right = build(b, 0.7);
  REQUIRE(left.problem.unknowns() == right.problem.unknowns());
  REQUIRE(left.problem.rows() == right.problem.rows());
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    CHECK((left.problem.blocks[k].K.lower() - right.problem.blocks[k].K.lower()).norm() == 0);
    CHECK(left.problem.blocks[k].f == right.problem.blocks[k].f);
  }
  CHECK((left.problem.B - right.problem.B).norm() == 0);
  CHECK(left.problem.c == right.problem.c);
}

}  // namespace

TEST_CASE("moved to where it is, a scene is the same to the last bit; moved on and back, too") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dim);
      const auto scene = setting(dim, family, rest);
      const auto same = scene::moved(*scene, points(*scene, rest));
      check_same(*same, *scene);
      const auto there = scene::moved(*scene, points(*scene, bend(dim))), back = scene::moved(*there, points(*scene, rest));
      check_same(*back, *scene);
      CHECK(back->bodies[1]->origin == scene->bodies[1]);  // not what lies between
      CHECK(back->contacts[0]->origin == scene->contacts[0]);
    }
}

TEST_CASE("a moved scene is the one set up there, all elements") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const auto multipliers : {contact::Multipliers::nodal, contact::Multipliers::p1_p0}) {
        CAPTURE(dim);
        const auto scene = setting(dim, family, rest, multipliers);
        check_same(*scene::moved(*scene, points(*scene, bend(dim))), *setting(dim, family, bend(dim), multipliers));
      }
}

TEST_CASE("a part before a rigid ball: flat and moved to where it is flat it is set up there; bent it keeps its frames, which make normals anew") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dim);
      const auto under_ball = [&](const Map& map) {
        const auto scene = scene::make_scene({block("block", dim, family, 0, map)});
        test::fix(scene->bodies[0], "bottom");
        Point above{0.4, 0.4, 0.4};
        above[dim - 1] = 4.2;
        scene::add_contact(*scene, test::part(scene->bodies[0], "top"), contact::RigidBall{above, 3}, constant(0.01), false);
        return scene;
      };
      const auto scene = under_ball(rest);
      const Map tilt = [&](const Point& x) {
        Point y{x[0] * 1.1, x[1], x[2]};
        y[dim - 1] = x[dim - 1] * (1 + 0.05 * x[0]);
        return y;
      };
      check_same(*scene::moved(*scene, points(*scene, tilt)), *under_ball(tilt));
      const auto bent = scene::moved(*scene, points(*scene, bend(dim)));
      const scene::Contact& contact = *bent->contacts[0];
      const auto sides = contact::nodes(*bent->bodies[0]->mesh, contact.first.facets);
      for (std::size_t k = 0; k < contact.rows.size(); ++k) {
        CHECK(contact.rows[k].mix == scene->contacts[0]->rows[k].mix);
        CHECK(contact.rows[k].normal == sides[k].normal);
      }
    }
}

TEST_CASE("slides on no axis turn with their parts; a slide on a whole circle, too") {
  const auto skew = [](double by) { return [=](const Point& x) { return Point{x[0] + by * x[1], x[1], 0}; }; };
  const auto oblique = [&](double by) {
    const auto b = block("b", 2, mesh::Family::q1, 0, skew(by));
    test::slide(b, "right");
    test::slide(b, "bottom");
    return scene::make_scene({b});
  };
  const auto from = oblique(0.3);
  REQUIRE(from->bodies[0]->slides.size() == 4);
  const auto to = oblique(0.5);
  check_same(*scene::moved(*from, {to->bodies[0]->mesh->coordinates}), *to);
  const auto round = [](const Map& map) {
    mesh::Mesh m = test::disc(mesh::Family::p1, 4);
    mesh::transform(m, map);
    const auto b = test::body("disc", std::move(m));
    test::slide(b, "boundary");
    test::springs(b, "boundary", {1, 1, 0});
    return scene::make_scene({b});
  };
  const auto disc = round(rest), ellipse = round([](const Point& x) { return Point{1.2 * x[0], 0.9 * x[1], 0}; });
  check_same(*scene::moved(*disc, {ellipse->bodies[0]->mesh->coordinates}), *ellipse);
}

TEST_CASE("loads, stiffness and springs that vary stay with their points: a dilation by 2 multiplies them by 2^d, 2^(d-2), 2^(d-1)") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dim);
      const auto field = [](const Point& x) { return Point{1 + x[0], x[0] * x[1], 2 - x[0]}; };
      const auto twice = [](const Point& x) { return Point{2 * x[0], 2 * x[1], 2 * x[2]}; };
      const auto made = [&](int what) {
        const auto b = block("b", dim, family, 0, bend(dim));
        auto right = test::part(b, "right");
        if (what == 0) scene::load_volume(*b, field);
        if (what == 1) scene::load(right, field, "a");
        if (what == 2) scene::pressure(right, [&](const Point& x) { return field(x)[1]; }, "a");
        return b;
      };
      for (int what = 0; what < 3; ++what) {
        const auto b = made(what), to = scene::moved(*scene::make_scene({b}), {points(*b, twice)})->bodies[0];
        const auto &before = what == 0 ? b->force : b->cases[0].force, &after = what == 0 ? to->force : to->cases[0].force;
        for (std::size_t k = 0; k < before.size(); ++k)
          CHECK(after[k] == doctest::Approx(std::pow(2, what == 0 ? dim : dim - 1) * before[k]).epsilon(1e-13));
        CHECK(scene::load_arrows(*to).size() == scene::load_arrows(*b).size());
      }
      const auto b = block("b", dim, family, 0, bend(dim));
      auto right = test::part(b, "right");
      scene::spring(right, {[&](const Point& x) { return field(x)[0]; }, nullptr, nullptr});
      const auto to = scene::moved(*scene::make_scene({b}), {points(*b, twice)})->bodies[0];
      std::vector<double> u(b->force.size(), 0.0);
      for (std::size_t k = 0; k < u.size(); ++k) u[k] = std::sin(static_cast<double>(k));
      const auto stiff = elasticity::internal_force(*b->mesh, b->material, {}, u), sprung = elasticity::internal_force(*b->mesh, b->material, b->facet_springs(), u),
                 force = elasticity::internal_force(*to->mesh, to->material, to->facet_springs(), u);
      for (std::size_t k = 0; k < u.size(); ++k)
        CHECK(force[k] == doctest::Approx(std::pow(2, dim - 2) * stiff[k] + std::pow(2, dim - 1) * (sprung[k] - stiff[k])).epsilon(1e-11));
    }
}

TEST_CASE("bodies at rest are shared, and so are contacts between them") {
  const auto scene = setting(2, mesh::Family::q1, rest);
  const auto up = [](const Point& x) { return Point{x[0], x[1] + 0.1, 0}; };
  const auto lifted = scene::moved(*scene, {{}, points(*scene->bodies[1], up)});
  CHECK(lifted->bodies[0] == scene->bodies[0]);
  CHECK(lifted->bodies[1] != scene->bodies[1]);
  CHECK(lifted->contacts[1] == scene->contacts[1]);
  for (const auto& row : lifted->contacts[0]->rows) CHECK(row.gap == doctest::Approx(0.1 + 0.01).epsilon(1e-14));
  CHECK(lifted->contacts[0]->tangential == scene->contacts[0]->tangential);
}

TEST_CASE("handles of the original work with solutions of its designs, and the other way round") {
  for (const auto family : test::kFamilies) {
    const auto made = [&](const Map& map) {
      const auto lower = block("lower", 2, family, 0, map), upper = block("upper", 2, family, 1, map);
      test::fix(lower, "bottom");
      test::symmetric(upper);
      test::press(upper, "top", 0.7);
      auto side = test::part(lower, "right");
      scene::support(side, problem::LawChoice{&problem::laws::elastic, 10}, {});
      const auto scene = scene::make_scene({lower, upper});
      scene::add_contact(*scene, test::part(lower, "top"), test::part(upper, "bottom"), {});
      return scene;
    };
    const auto scene = made(rest), there = made(bend(2));
    const auto design = scene::moved(*scene, points(*scene, bend(2)));
    const auto of_design = test::solve(design), of_there = test::solve(there);
    const auto bottom = test::part(scene->bodies[0], "bottom"), right = test::part(scene->bodies[0], "right");
    CHECK(of_design->scene().index_of(scene->bodies[1].get()) == 1);
    CHECK(of_design->reaction(bottom) == of_there->reaction(test::part(there->bodies[0], "bottom")));
    CHECK(of_design->support(right).force == of_there->support(test::part(there->bodies[0], "right")).force);
    const auto mine = of_design->contact(*scene->contacts[0]), right_one = of_there->contact(*there->contacts[0]);
    CHECK(mine.force == right_one.force);
    CHECK(mine.nodes[1].x == right_one.nodes[1].x);
    CHECK_NOTHROW(test::solve(scene)->contact(*design->contacts[0]));
    CHECK_THROWS_AS(of_design->contact(*there->contacts[0]), InputError);
    CHECK_THROWS_AS(of_design->reaction(test::part(there->bodies[0], "bottom")), InputError);
    CHECK_THROWS_WITH_AS(scene::add_contact(*design, test::part(scene->bodies[0], "left"), contact::RigidPlane{{-1, 0, 0}, {1, 0, 0}}, {}, false),
                         doctest::Contains("belongs to another design of 'lower'"), InputError);
  }
}

TEST_CASE("glue keeps its pairs") {
  const auto lower = block("lower", 2, mesh::Family::p1, 0, rest), upper = block("upper", 2, mesh::Family::p1, 1, rest);
  const auto scene = scene::make_scene({lower, upper});
  scene::add_glue(*scene, test::part(lower, "top"), test::part(upper, "bottom"));
  const auto there = scene::moved(*scene, points(*scene, bend(2)));
  REQUIRE(there->contacts[0]->glued.size() == 4);
  for (const auto& pair : there->contacts[0]->glued)
    CHECK(there->bodies[0]->mesh->point(pair.node) == there->bodies[1]->mesh->point(pair.partners.front().node));
  CHECK(there->contacts[0]->first.body == there->bodies[0]);
}

TEST_CASE("what cannot move is refused, and why") {
  const auto refused = [](const scene::Scene& scene, const std::vector<std::vector<double>>& to, const char* why) {
    CHECK_THROWS_WITH_AS(scene::moved(scene, to), doctest::Contains(why), InputError);
  };
  const auto scene = setting(2, mesh::Family::q1, rest);
  refused(*scene, {}, "the scene has 2 bodies; points are given for 0");
  refused(*scene, {{}, {1, 2}}, "'upper' has 16 nodes, 32 coordinates; 2 are given");
  refused(*scene, points(*scene, [](const Point& x) { return Point{-x[0], x[1], 0}; }), "body 'lower' where its nodes have moved to: cell 1 (a quadrilateral near");
  refused(*scene, points(*scene, [](const Point& x) { return Point{x[0] + 0.1 * x[1], x[1], 0}; }), "'lower' left slides, its normal along x, but where its nodes");
  const auto down = [](const Point& x) { return Point{x[0], x[1] - 0.1, 0}; };
  refused(*scene, {{}, points(*scene->bodies[1], down)}, "overlap by 0.09 at ");
  refused(*scene, points(*scene, [](const Point& x) { return Point{2 * x[0], x[1], 0}; }), "rigid plane penetrates the part by");
  // A dent in the middle of the side by laws makes corners of 63 degrees.
  const auto dent = [](const Point& x) { return Point{x[0] > 0.9 && std::abs(x[1] - 1.0 / 3) < 0.01 ? 0.8 : x[0], x[1], 0}; };
  refused(*scene, {points(*scene->bodies[0], dent), {}}, "'lower' right: where its nodes have moved to, the part has 2 sides at (0.8, 0.333333), where it had 1");
}

TEST_CASE("an overlap that is meant stays meant") {
  const auto lower = block("lower", 3, mesh::Family::q1, 0, rest), upper = block("upper", 3, mesh::Family::q1, 1, rest);
  const auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(lower, "top"), test::part(upper, "bottom"), {}, {}, true);
  const auto down = scene::moved(*scene, {{}, points(*upper, [](const Point& x) { return Point{x[0], x[1], x[2] - 0.1}; })});
  for (const auto& row : down->contacts[0]->rows) CHECK(row.gap == doctest::Approx(-0.1).epsilon(1e-14));
}

TEST_CASE("a rigid gap stays with a part that rests, and is refused to one that moves") {
  const auto b = block("b", 2, mesh::Family::p1, 0, rest);
  test::fix(b, "bottom");
  const auto scene = scene::make_scene({b});
  scene::add_contact(*scene, test::part(b, "top"), contact::RigidGap{{0, 1, 0}, [](const Point& x) { return 0.1 + x[0]; }}, {}, false);
  const auto wide = scene::moved(*scene, {points(*b, [](const Point& x) { return Point{x[0] + 0.1 * x[1] * (1 - x[1]), x[1], 0}; })});
  CHECK(wide->contacts[0]->rows.size() == 4);
  CHECK(wide->contacts[0]->rows[1].gap == scene->contacts[0]->rows[1].gap);
  CHECK_THROWS_WITH_AS(scene::moved(*scene, {points(*b, [](const Point& x) { return Point{x[0], 1.1 * x[1], 0}; })}),
                       doctest::Contains("rigid gap cannot follow its part, whose nodes move"), InputError);
}
