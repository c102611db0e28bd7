// Solved plates and what their pictures show.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/plain_laws.hpp"
#include "figure/compose/compose_plate.hpp"
#include "mesh/generators.hpp"
#include "pixels.hpp"
#include "plate/reaction.hpp"
#include "plate/solution.hpp"

using namespace dotyk;
using namespace dotyk::figure;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kHeld;

namespace {

plate::LawField everywhere(const LawChoice& law) {
  return [law](double, double) { return law; };
}

// The unit square under f; the same law along every side.
plate::Plate square_model(int n, double f, const LawChoice& deflection, const LawChoice& rotation = {}) {
  const double from[2] = {0, 0}, to[2] = {1, 1};
  const int cells[2] = {n, n};
  const mesh::Grading even[2];
  plate::Plate p;
  p.mesh = std::make_shared<mesh::Mesh>(mesh::rectangle(from, to, cells, mesh::Family::p1, even));
  p.f = f;
  for (const auto& [name, facets] : p.mesh->parts) p.edges.push_back({name, facets, everywhere(deflection), everywhere(rotation)});
  return p;
}

std::shared_ptr<const plate::Solution> solved(const plate::Plate& p) {
  Monitor quiet;
  return plate::solve(std::make_shared<plate::Model>(plate::build(p)), {}, quiet);
}

// ∫ of the strips and the forces at points.
double carried(const PlatePicture& p) {
  double sum = 0;
  for (const PlateEdge& e : p.boundary)
    sum += std::hypot(e.to[0] - e.from[0], e.to[1] - e.from[1]) * (e.samples.front().reaction + e.samples.back().reaction) / 2;
  for (const PlateForce& f : p.forces) sum += f.force;
  return sum;
}

constexpr LawChoice stop{&laws::signorini, 0, 0, 0};

}  // namespace

TEST_CASE("reactions drawn along the edges and at the corners carry the load") {
  // What a strip carries beside a corner is extrapolated: the sum is right to first order at least.
  for (const plate::Element element : {plate::Element::morley, plate::Element::hct})
    for (const LawChoice& law : {kHeld, stop}) {
      double error[2];
      for (const int fine : {0, 1}) {
        const int n = fine ? 16 : 8;
        plate::Plate p = square_model(n, -3, law);
        p.element = element;
        const PlatePicture picture = compose(*solved(p), {});
        error[fine] = std::abs(carried(picture) / 3 - 1);
        REQUIRE(picture.boundary.size() == static_cast<std::size_t>(4 * n));
        for (std::size_t i = 0; i < picture.boundary.size(); ++i) CHECK(picture.boundary[i].to == picture.boundary[(i + 1) % picture.boundary.size()].from);
      }
      CAPTURE(error[0]);
      CAPTURE(error[1]);
      CHECK(error[0] < 0.03);
      CHECK(error[1] < std::max(0.5 * error[0], 1e-9));
    }
}

TEST_CASE("a simply supported square is pulled down at its corners") {
  // Timoshenko and Woinowsky-Krieger, table 8: 0.065 q a² at each, for ν = 0.3.
  plate::Plate p = square_model(16, -1, kHeld);
  p.element = plate::Element::hct;
  const PlatePicture picture = compose(*solved(p), {});
  REQUIRE(picture.forces.size() == 4);
  for (const PlateForce& f : picture.forces) CHECK(f.force == doctest::Approx(-0.065).epsilon(0.1));
  for (const PlateEdge& e : picture.boundary) {
    CHECK(e.support == PlateSupport::held);
    CHECK(!e.samples[0].status);
  }
}

TEST_CASE("one-sided edges let the corners go") {
  const PlatePicture picture = compose(*solved(square_model(16, -1, stop)), {});
  int open = 0;
  for (const PlateEdge& e : picture.boundary)
    for (const EdgeSample& s : e.samples) {
      REQUIRE(s.status);
      open += *s.status == Status::open;
      if (*s.status == Status::closed) CHECK(std::abs(s.deflection) <= 1e-12);
      CHECK(s.reaction >= -1e-9);
    }
  CHECK(open > 8);
  CHECK(picture.forces.empty());
  const double greatest = *std::max_element(picture.deflection.begin(), picture.deflection.end());
  CHECK(picture.deflection[0] == greatest);
  CHECK(greatest > 0);
}

TEST_CASE("a field that is asked for is that of the vertices") {
  const auto s = solved(square_model(6, -1, kHeld));
  const auto values = [&](PlateField field) { return compose(*s, {PlateView::plan, field, {}, {"m", "kN"}}).values; };
  for (std::size_t i = 0; i < values(PlateField::xx).size(); ++i) {
    const double xx = values(PlateField::xx)[i], yy = values(PlateField::yy)[i], xy = values(PlateField::xy)[i];
    const double one = values(PlateField::greatest)[i], two = values(PlateField::least)[i];
    CHECK(one + two == doctest::Approx(xx + yy));
    CHECK(one * two == doctest::Approx(xx * yy - xy * xy).epsilon(1e-9).scale(1e-3));
    CHECK(values(PlateField::von_mises)[i] == doctest::Approx(std::sqrt(xx * xx - xx * yy + yy * yy + 3 * xy * xy)));
  }
  CHECK(values(PlateField::none).empty());
  CHECK(compose(*s, {PlateView::plan, PlateField::xx, {}, {"m", "kN"}}).field_unit == "kN");
  CHECK(compose(*s, {PlateView::plan, PlateField::xx, {}, {"m", "kN"}}).reaction_unit == "kN/m");
}

TEST_CASE("the factor makes the greatest deflection 8 to 20 % of the size") {
  for (const double f : {-1e-6, -1.0, 7.0, 1e5}) {
    const auto s = solved(square_model(4, f, kHeld));
    double most = 0;
    for (const double u : compose(*s, {}).deflection) most = std::max(most, std::abs(u));
    CHECK(visible_deflection(*s) * most <= 0.2 * (1 + 1e-12));
    CHECK(visible_deflection(*s) * most >= 0.08);
  }
  CHECK(visible_deflection(*solved(square_model(4, 0, kHeld))) == 1);
}

TEST_CASE("plates on everything are drawn") {
  plate::Plate p = square_model(12, -1, stop);
  p.edges[1].deflection = everywhere(kHeld), p.edges[1].rotation = everywhere(kHeld);
  p.edges[2].deflection = everywhere({&laws::friction, 0.2, 0, 0});
  p.edges.erase(p.edges.begin());  // a free side
  p.supports = {{0.3, 0.3, stop}, {0.6, 0.7, {&laws::elastic, 100, 0, 0}}};
  p.obstacle = [](double x, double y) { return x < 0.5 ? -0.001 : y < 0.2 ? -INFINITY : -1e6; };
  const auto s = solved(p);
  PlatePicture picture = compose(*s, {});
  CHECK(picture.supports.size() == 2);
  CHECK(!picture.bearing.empty());
  for (const int i : picture.bearing) {
    const auto k = static_cast<std::size_t>(i);
    CHECK(picture.deflection[k] == doctest::Approx(-0.001));
    CHECK(picture.deflection[k] == doctest::Approx(picture.obstacle[k]));
  }
  picture.file = "composed.png", picture.width = 720, picture.height = 540;
  for (const PlateView view : {PlateView::surface, PlateView::plan}) {
    picture.view = view;
    CHECK(message_of([&] { draw(picture); }) == "");
    CHECK(white_rim(read_png("composed.png")));
  }
}

TEST_CASE("one part all around is drawn as its four sides are") {
  const plate::Plate sides = square_model(8, -1, kHeld);
  plate::Plate around = sides;
  around.edges = {{"edge", mesh::boundary(*around.mesh), everywhere(kHeld), {}}};
  const PlatePicture a = compose(*solved(sides), {}), b = compose(*solved(around), {});
  REQUIRE(a.boundary.size() == b.boundary.size());
  for (std::size_t i = 0; i < a.boundary.size(); ++i)
    for (const std::size_t end : {0, 1}) CHECK(a.boundary[i].samples[end].reaction == doctest::Approx(b.boundary[i].samples[end].reaction).epsilon(1e-9));
}

TEST_CASE("no edge bears more than its friction") {
  plate::Plate p = square_model(12, -1, kHeld);
  p.edges[2].deflection = everywhere({&laws::friction, 0.2, 0, 0});
  int slipping = 0;
  for (const PlateEdge& e : compose(*solved(p), {}).boundary)
    for (const EdgeSample& s : e.samples) {
      if (e.support != PlateSupport::friction) continue;
      REQUIRE(s.status);
      CHECK((*s.status == Status::stick || *s.status == Status::slip));
      CHECK(std::abs(s.reaction) <= 0.2 * (1 + 1e-9));
      slipping += *s.status == Status::slip;
    }
  CHECK(slipping > 0);
}

TEST_CASE("edges and point supports carry the load where rows reach what is held") {
  // The rows: of edge middles on a curved edge (HCT), of a point support in a cell at the edge.
  const auto total = [](const plate::Solution& s) {
    double sum = 0;
    for (std::size_t k = 0; k < s.plate().edges.size(); ++k) sum += plate::reaction(s, static_cast<int>(k)).force;
    for (std::size_t k = 0; k < s.plate().supports.size(); ++k) sum += plate::point_reaction(s, static_cast<int>(k));
    return sum;
  };
  for (const plate::Element element : {plate::Element::morley, plate::Element::hct}) {
    plate::Plate p = square_model(8, -1, kHeld);
    p.element = element;
    p.supports = {{0.95, 0.52, {&laws::prescribed, 0.01, 0, 0}}};
    CHECK(total(*solved(p)) == doctest::Approx(1).epsilon(1e-9));
    const double centre[2] = {0, 0};
    p.supports.clear();
    p.mesh = std::make_shared<mesh::Mesh>(mesh::disc(centre, 1, 5, mesh::Family::p1));
    p.edges = {{"edge", mesh::boundary(*p.mesh), everywhere(kHeld), {}}};
    const double area = 15 * std::sin(2 * std::acos(-1.0) / 30);  // of the polygon
    CHECK(total(*solved(p)) == doctest::Approx(area).epsilon(1e-9));
  }
}
