// Pictures read back: what is drawn, and where, is what was solved.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "../support/plain_laws.hpp"
#include "beam/solve.hpp"
#include "elasticity/material.hpp"
#include "figure/compose/compose.hpp"
#include "figure/compose/compose_beam.hpp"
#include "figure/door/marks.hpp"
#include "mesh/generators.hpp"

using namespace dotyk;
using namespace dotyk::figure;
namespace laws = dotyk::problem::laws;
using Place = std::array<double, 2>;

namespace read_back {

namespace {

std::vector<DataMark> of(const std::vector<DataMark>& marks, const std::string& what, std::size_t points = 0) {
  std::vector<DataMark> out;
  std::ranges::copy_if(marks, std::back_inserter(out), [&](const DataMark& m) { return m.what == what && (points == 0 || m.at.size() == points); });
  return out;
}

bool has(const std::vector<DataMark>& marks, const std::string& what) { return !of(marks, what).empty(); }

double apart(const Place& p, const Place& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); }
double size_of(const DataMark& arrow) { return apart(arrow.at.front(), arrow.at.back()); }

Place drawn(const ContactNode& node, double factor) { return {node.position[0] + factor * node.displacement[0], node.position[1] + factor * node.displacement[1]}; }

elasticity::MaterialField material(double E) { return elasticity::MaterialField(elasticity::isotropic(E, 0.3, 2, elasticity::Plane::strain)); }

std::shared_ptr<scene::Body> rectangle(const Place& from, const Place& to, int nx, int ny) {
  const int cells[2] = {nx, ny};
  const mesh::Grading even[2];
  return scene::make_body("block", std::make_shared<mesh::Mesh>(mesh::rectangle(from.data(), to.data(), cells, mesh::Family::q1, even)), material(1000), {});
}

std::shared_ptr<scene::Solution> solved(const std::shared_ptr<scene::Scene>& s) {
  Monitor quiet;
  return scene::solve(s, {}, {}, quiet);
}

ScenePicture picture_of(const scene::Solution& s, double factor) {
  SceneOptions options;
  options.deform = factor, options.supports = options.loads = true;
  ScenePicture picture = compose(s, options);
  picture.file = "marks.png";
  return picture;
}

/// At each place where some node is drawn: does one of the contacts bear there?
std::map<Place, bool> bearing_places(const ScenePicture& picture) {
  std::map<Place, bool> out;
  for (const ContactPicture& contact : picture.contacts)
    for (const ContactNode& node : contact.nodes) out[drawn(node, picture.deformation)] |= node.status != Status::open;
  return out;
}

/// Markers and lines say of each place whether it bears.
void check_statuses(const ScenePicture& picture, const std::vector<DataMark>& marks) {
  const std::map<Place, bool> places = bearing_places(picture);
  std::map<std::pair<double, double>, bool> seen;  // the marker that is drawn last
  for (const DataMark& mark : marks) {
    const bool status = mark.what == "open" || mark.what == "closed" || mark.what == "stick" || mark.what == "slip";
    if (!status) continue;
    for (const auto& [place, bears] : places) {
      if (mark.at.size() == 1 && apart(mark.at[0], place) < 1e-6) seen[{place[0], place[1]}] = mark.what != "open";
      if (mark.at.size() != 2) continue;
      const double begin = apart(mark.at[0], place), end = apart(mark.at[1], place);
      if (begin < 1e-6) CHECK(bears == (mark.what != "open"));
      if (begin > 1e-6 && end > 1e-6) CHECK(begin + end > (1 + 1e-9) * size_of(mark));  // no node within
      // Where the drawn pressure ends, and no earlier, "open" begins.
      if (end < 1e-6 && bears) CHECK((mark.what != "open" || size_of(mark) < 1e-6));
    }
  }
  CHECK(seen.size() >= 6);
  for (const auto& [place, bears] : seen) CHECK(bears == places.at({place.first, place.second}));
}

/// The area under the ordinates of one contact, in units of pressure times length.
double carried(const ScenePicture& picture, const ContactPicture& contact, const std::vector<DataMark>& ordinates, double per_pressure) {
  const auto height = [&](int i) {
    if (!(contact.nodes[i].pressure > 0)) return 0.0;
    const Place foot = drawn(contact.nodes[i], picture.deformation);
    const auto found = std::ranges::find_if(ordinates, [&](const DataMark& o) { return apart(o.at[0], foot) < 1e-6; });
    return found == ordinates.end() ? 0.0 : size_of(*found) / per_pressure;
  };
  double sum = 0;
  for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
    const int i = contact.facets[f], j = contact.facets[f + 1];
    sum += (height(i) + height(j)) / 2 * apart(drawn(contact.nodes[i], 0), drawn(contact.nodes[j], 0));
  }
  return sum;
}

double length_of(const Vec3& v) { return std::hypot(v[0], v[1]); }

}  // namespace

TEST_CASE("two contacts on one part: what bears in either is drawn as bearing, and the obstacles are where they are") {
  const double centre[2] = {0, 0};
  auto seal = scene::make_body("seal", std::make_shared<mesh::Mesh>(mesh::disc(centre, 5, 16, mesh::Family::p1)), material(10), {});
  const auto s = scene::make_scene({seal});
  const auto lower = scene::add_contact(*s, scene::named_part(seal, "boundary"), contact::RigidPlane{{0, -5, 0}, {0, 1, 0}}, {}, false);
  const auto upper = scene::add_contact(*s, scene::named_part(seal, "boundary"), contact::RigidPlane{{0, 3, 0}, {0, -1, 0}}, {}, true);
  const auto solution = solved(s);
  const ScenePicture picture = picture_of(*solution, 1);
  const std::vector<DataMark> all = marks(picture);
  check_statuses(picture, all);
  const std::vector<DataMark> obstacles = of(all, "obstacle"), ordinates = of(all, "pressure");
  REQUIRE(obstacles.size() == 2);
  for (const Place& p : obstacles[0].at) CHECK(p[1] == doctest::Approx(-5));
  for (const Place& p : obstacles[1].at) CHECK(p[1] == doctest::Approx(3));
  const double edge = 5 * 2 * std::numbers::pi / 96;  // of a cell at the circle: where the line ends
  for (const DataMark& line : obstacles) CHECK(std::abs(line.at.front()[0] + line.at.back()[0]) < edge);
  const double most = std::max(solution->contact(*lower).max_pressure, solution->contact(*upper).max_pressure);
  const double per_pressure = size_of(*std::ranges::max_element(ordinates, {}, size_of)) / most;
  for (std::size_t c = 0; c < 2; ++c)
    CHECK(carried(picture, picture.contacts[c], ordinates, per_pressure) == doctest::Approx(std::abs(solution->contact(c == 0 ? *lower : *upper).force[1])).epsilon(0.02));
}

TEST_CASE("arrows of the shear are alike on both sides, have the greatest, and the scale of the pressure") {
  auto block = rectangle({-10, -10}, {10, 0}, 80, 40);
  auto bottom = scene::named_part(block, "bottom");
  scene::fix(bottom, {true, true, true});
  const auto s = scene::make_scene({block});
  const scene::GivenLaw friction{problem::laws::coulomb, [](const mesh::Point&) { return 0.2; }};
  const auto contact = scene::add_contact(*s, scene::named_part(block, "top"), contact::RigidBall{{0, 49.9, 0}, 50}, {}, true, friction);
  const auto solution = solved(s);
  const ScenePicture picture = picture_of(*solution, 1);
  const std::vector<DataMark> all = marks(picture), arrows = of(all, "shear"), ordinates = of(all, "pressure");
  check_statuses(picture, all);
  const scene::ContactResult result = solution->contact(*contact);
  const double per_pressure = size_of(*std::ranges::max_element(ordinates, {}, size_of)) / result.max_pressure;
  REQUIRE(arrows.size() >= 2);
  double most = 0, longest = 0;
  for (const auto& node : result.nodes) most = std::max(most, length_of(node.shear));
  for (const DataMark& arrow : arrows) {
    const double x = (arrow.at[0][0] + arrow.at[1][0]) / 2, way = arrow.at[1][0] - arrow.at[0][0];
    const auto node = std::ranges::min_element(picture.contacts[0].nodes, {}, [&](const ContactNode& n) { return std::abs(drawn(n, 1)[0] - x); });
    CHECK(way * node->shear[0] > 0);
    CHECK(size_of(arrow) == doctest::Approx(per_pressure * length_of(node->shear)).epsilon(1e-3));
    CHECK(node->status != Status::open);
    longest = std::max(longest, size_of(arrow));
    CHECK(std::ranges::any_of(arrows, [&](const DataMark& other) { return std::abs(other.at[0][0] + arrow.at[0][0]) < 1e-3 && std::abs(other.at[1][0] + arrow.at[1][0]) < 1e-3; }));
  }
  CHECK(longest == doctest::Approx(per_pressure * most).epsilon(1e-3));
}

TEST_CASE("arrows of the shear stay between the ends of the contact line") {
  auto block = rectangle({0, 0}, {4, 1}, 20, 5);
  auto top = scene::named_part(block, "top");
  scene::load(top, [](const mesh::Point& x) { return mesh::Point{-0.3 * x[0], -1 - x[0], 0}; });
  const auto s = scene::make_scene({block});
  const scene::GivenLaw friction{problem::laws::coulomb, [](const mesh::Point&) { return 0.5; }};
  scene::add_contact(*s, scene::named_part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false, friction);
  const ScenePicture picture = picture_of(*solved(s), 1);
  const auto [left, right] = std::ranges::minmax(picture.contacts[0].nodes, {}, [](const ContactNode& n) { return drawn(n, 1)[0]; });
  const std::vector<DataMark> arrows = of(marks(picture), "shear");
  CHECK(std::ranges::any_of(arrows, [&](const DataMark& arrow) { return std::abs(arrow.at[0][0] - drawn(right, 1)[0]) < 1e-6; }));  // it was half beyond
  for (const DataMark& arrow : arrows)
    for (const Place& end : arrow.at) {
      CHECK(end[0] > drawn(left, 1)[0] - 1e-6);
      CHECK(end[0] < drawn(right, 1)[0] + 1e-6);
    }
}

TEST_CASE("a shear that is nothing beside the pressure has no arrow") {
  auto block = rectangle({0, 0}, {1, 1}, 8, 8);
  const auto s = scene::make_scene({block});
  auto left = scene::named_part(block, "left"), top = scene::named_part(block, "top");
  scene::slide(left);
  scene::pressure(top, [](const mesh::Point&) { return 8.5; });
  scene::add_contact(*s, scene::named_part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  ScenePicture picture = picture_of(*solved(s), 1);
  for (ContactNode& node : picture.contacts[0].nodes) node.shear = {4e-5 * node.position[0], 0, 0};
  const std::vector<DataMark> all = marks(picture);
  CHECK_FALSE(has(all, "shear"));
  CHECK(std::ranges::none_of(all, [](const DataMark& m) { return m.what.starts_with("legend: shear"); }));
}

TEST_CASE("loads are drawn over the whole of their part, each as long as it is great") {
  auto block = rectangle({0, 0}, {40, 30}, 80, 60);
  auto bottom = scene::named_part(block, "bottom");
  scene::fix(bottom, {true, true, true});
  scene::Part washer = scene::named_part(block, "top"), right = scene::named_part(block, "right");
  std::erase_if(washer.facets, [&](mesh::Facet f) { const double x = block->mesh->facet_centre(f)[0]; return x < 10 || x > 22; });
  washer.name = "washer";
  scene::pressure(washer, [](const mesh::Point&) { return 7.0; });
  scene::load(right, [](const mesh::Point&) { return mesh::Point{3.5, 0, 0}; });
  const auto s = scene::make_scene({block});
  const std::vector<DataMark> all = marks(picture_of(*solved(s), 1)), arrows = of(all, "load"), lines = of(all, "loaded");
  double down = 0, aside = 0;
  for (const DataMark& a : arrows) {
    const double dx = a.at[1][0] - a.at[0][0], dy = a.at[1][1] - a.at[0][1];
    CHECK(std::abs(std::abs(dy) - std::abs(dx)) == doctest::Approx(std::abs(dx) > std::abs(dy) ? dx : -dy));  // to the right, or down
    (std::abs(dy) > std::abs(dx) ? down : aside) = size_of(a);
  }
  CHECK(down == doctest::Approx(2 * aside).epsilon(1e-3));
  REQUIRE(lines.size() == 2);
  const DataMark& over = *std::ranges::max_element(lines, {}, [](const DataMark& m) { return m.at[0][1] + m.at.back()[1]; });
  const auto [low, high] = std::ranges::minmax(std::array{over.at.front()[0], over.at.back()[0]});
  CHECK(low == doctest::Approx(10.25).epsilon(0.02));
  CHECK(high == doctest::Approx(21.75).epsilon(0.02));
}

TEST_CASE("the ground of springs stays, what does not act stays with it") {
  auto strip = rectangle({0, 0}, {3, 0.1}, 160, 8);
  auto left = scene::named_part(strip, "left"), bottom = scene::named_part(strip, "bottom"), patch = scene::named_part(strip, "top");
  std::erase_if(patch.facets, [&](mesh::Facet f) { return strip->mesh->facet_centre(f)[0] > 0.1; });
  patch.name = "patch";
  scene::slide(left);
  scene::support(bottom, problem::LawChoice{&problem::laws::one_sided_elastic, 1.7}, {});
  scene::pressure(patch, [](const mesh::Point&) { return 0.5; });
  const auto s = scene::make_scene({strip});
  const auto solution = solved(s);
  const ScenePicture picture = picture_of(*solution, 5);
  const std::vector<DataMark> all = marks(picture), springs = of(all, "spring"), open = of(all, "open support");
  REQUIRE(springs.size() >= 2);
  REQUIRE(open.size() >= 2);
  CHECK(has(all, "legend: support open"));
  const double ground = springs[0].at[1][1];
  const auto support = solution->support(scene::named_part(strip, "bottom"));
  const auto state_at = [&](double x) { return std::ranges::min_element(support.nodes, {}, [&](const auto& n) { return std::abs(n.x[0] - x); }); };
  for (const DataMark& m : springs) {
    const auto node = state_at(m.at[1][0]);
    CHECK(node->status != problem::Status::open);
    CHECK(m.at[1][1] == doctest::Approx(ground));
    CHECK(m.at[0][1] == doctest::Approx(-5 * -node->away).epsilon(1e-3));  // away is along the inner normal, up
    CHECK(m.at[0][1] > ground);
  }
  for (const DataMark& m : open) {
    CHECK(state_at(m.at[1][0])->status == problem::Status::open);
    CHECK(m.at[0][1] == doctest::Approx(0).scale(1));
    CHECK(m.at[1][1] == doctest::Approx(ground));
  }
}

TEST_CASE("ordinates of the pressure in a hole do not cross") {
  ScenePicture picture;
  picture.file = "hole.png";
  BodyPicture& body = picture.bodies.emplace_back();
  body.shape = CellShape::quad;
  ContactPicture& contact = picture.contacts.emplace_back();
  constexpr int n = 48;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, c = std::cos(a), s = std::sin(a);
    body.points.insert(body.points.end(), {10 * c, 10 * s, 0, 90 * c, 90 * s, 0});
    const int k = 2 * i, next = 2 * ((i + 1) % n);
    body.cells.insert(body.cells.end(), {k, k + 1, next + 1, next});
    ContactNode node;
    node.position = {10 * c, 10 * s, 0}, node.normal = {-c, -s, 0}, node.pressure = std::max(0.0, -c);
    node.status = node.pressure > 0 ? Status::closed : Status::open;
    contact.nodes.push_back(node);
    contact.facets.insert(contact.facets.end(), {i, (i + 1) % n});
  }
  const std::vector<DataMark> ordinates = of(marks(picture), "pressure");
  REQUIRE(ordinates.size() > 5);
  for (const DataMark& o : ordinates) CHECK(o.at[0][0] * o.at[1][0] + o.at[0][1] * o.at[1][1] > 10);
}

TEST_CASE("a magnification that moves an obstacle's gaps is named") {
  const auto legend = [](double gap, double factor) {
    auto block = rectangle({0, 0}, {1, 1}, 4, 4);
    auto top = scene::named_part(block, "top");
    scene::displace(top, {nullptr, [](const mesh::Point&) { return -0.02; }, nullptr});
    const auto s = scene::make_scene({block});
    scene::add_contact(*s, scene::named_part(block, "bottom"), contact::RigidGap{{0, -1, 0}, [gap](const mesh::Point& x) { return gap + 0.01 * x[0] * (gap > 0); }}, {}, false);
    auto left = scene::named_part(block, "left");
    scene::slide(left);
    return marks(picture_of(*solved(s), factor));
  };
  CHECK(has(legend(0.001, 5), "legend: deformation and gaps × 5"));
  CHECK(has(legend(0, 5), "legend: deformation × 5"));
  CHECK(has(legend(0.001, 1), "legend: true scale"));
}

TEST_CASE("a map of statuses has windows, and its markers tell what was solved") {
  const double from[3] = {0, 0, 0}, to[3] = {1, 1, 1};
  const int cells[3] = {6, 6, 6};
  const mesh::Grading even[3];
  auto block = scene::make_body("block", std::make_shared<mesh::Mesh>(mesh::box(from, to, cells, mesh::Family::q1, even)), elasticity::MaterialField(elasticity::isotropic(1000, 0.3, 3, elasticity::Plane::strain)), {});
  auto top = scene::named_part(block, "top"), left = scene::named_part(block, "left");
  scene::slide(left);
  scene::load(top, [](const mesh::Point&) { return mesh::Point{3, 0, -5}; });
  const auto s = scene::make_scene({block});
  const auto contact = scene::add_contact(*s, scene::named_part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 0, 1}}, {}, false,
                                         scene::GivenLaw{problem::laws::coulomb, [](const mesh::Point&) { return 0.2; }});
  const auto solution = solved(s);
  ScenePicture map = compose_map(*solution, *contact, FieldChoice::pressure);
  map.file = "map.png";
  int told = 0;
  for (const DataMark& m : marks(map)) {
    if (m.at.size() != 1) continue;
    const auto nodes = solution->contact(*contact).nodes;
    const auto node = std::ranges::min_element(nodes, {}, [&](const auto& n) { return apart({n.x[0], n.x[1]}, m.at[0]); });
    CHECK(m.what == status_name(static_cast<Status>(static_cast<int>(node->status))));
    ++told;
  }
  CHECK(told > 4);
  ScenePicture statuses = compose_map(*solution, *contact, FieldChoice::status);
  statuses.file = "map.png", statuses.window = {0.1, 0.1, 0.6, 0.6};
  CHECK(has(marks(statuses), "legend: stick") == std::ranges::any_of(solution->contact(*contact).nodes, [](const auto& n) { return n.status == problem::Status::stick && n.x[0] >= 0.1 && n.x[0] <= 0.6 && n.x[1] >= 0.1 && n.x[1] <= 0.6; }));
}

TEST_CASE("a stop stands where it is, and a working point has the colour of its support's state") {
  Monitor quiet;
  const auto beam = [&](double force) {
    beam::Beam b;
    b.cells = 8;
    b.supports = {{"left", 0, test::kHeld, test::kHeld}, {"x = 0.5", 0.5, {&laws::signorini, 0, 0}, test::kFree, -0.02}, {"right", 1, {&laws::elastic, 5, 0}, test::kFree, 0.01}};
    b.loads = {{1, force, 0}};
    return beam::solve(b, {}, quiet)[0].solution;
  };
  const auto stopped = beam(-1), free = beam(-0.01);
  const auto read = [](PagePicture page) {
    page.file = "beam.png";
    return marks(page);
  };
  const std::vector<DataMark> page = read(compose(view(*stopped), {BeamPanel::deflection}, {})), stop = of(page, "pushing", 3), spring = of(page, "acting", 3);
  REQUIRE(stop.size() == 1);
  CHECK(stop[0].at[0][0] == doctest::Approx(0.5));
  CHECK(stop[0].at[0][1] == doctest::Approx(-0.02));
  REQUIRE(spring.size() == 1);
  CHECK(spring[0].at[0][1] == doctest::Approx(0.01));
  CHECK(spring[0].at[1][1] == doctest::Approx(stopped->deflection(1)));
  CHECK(spring[0].at[2][1] < spring[0].at[1][1]);
  CHECK(has(read(compose(view(*stopped), 1, LawSide::deflection, {})), "pushing"));
  const std::vector<DataMark> law = read(compose(view(*free), 1, LawSide::deflection, {}));
  CHECK(has(law, "open"));
  CHECK_FALSE(has(law, "pushing"));
}

TEST_CASE("a guide of a slope stands beside the curve that has it") {
  ChartPicture chart;
  chart.file = "slopes.png";
  chart.log_x = chart.log_y = true;
  SeriesPicture low, high;
  low.name = "P2", high.name = "P1";
  low.x = high.x = {1 / 64.0, 1 / 32.0, 1 / 16.0, 1 / 8.0, 1 / 4.0};
  low.y = {0.0085, 0.0231, 0.0637, 0.172, 0.369}, high.y = {0.0647, 0.1225, 0.2207, 0.369, 0.558};  // slopes 1.46 to 1.1, 0.92 to 0.6
  chart.series = {high, low};
  chart.slopes = {{1, ""}, {1.5, ""}};
  const std::vector<DataMark> guides = of(marks(chart), "slope guide");
  REQUIRE(guides.size() == 2);
  const auto off = [](const SeriesPicture& s, const DataMark& guide) {  // in decades
    double least = INFINITY;
    for (const Place& p : guide.at)
      for (std::size_t i = 0; i + 1 < s.x.size(); ++i)
        for (double t = 0; t <= 1; t += 0.1)
          least = std::min(least, std::hypot(std::log10(p[0] / s.x[i]) - t * std::log10(s.x[i + 1] / s.x[i]), std::log10(p[1] / s.y[i]) - t * std::log10(s.y[i + 1] / s.y[i])));
    return least;
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [left, right] = std::ranges::minmax(guides[k].at, {}, [](const Place& p) { return p[0]; });
    const auto [bottom, top] = std::ranges::minmax(guides[k].at, {}, [](const Place& p) { return p[1]; });
    CHECK(std::log(top[1] / bottom[1]) / std::log(right[0] / left[0]) == doctest::Approx(k == 0 ? 1 : 1.5).epsilon(0.01));
    CHECK(off(k == 0 ? high : low, guides[k]) < off(k == 0 ? low : high, guides[k]));
  }
}

TEST_CASE("ordinates of a plate's edge are as long as its reactions are great, and point supports stand where they are") {
  PlatePicture p;
  p.file = "plan.png", p.view = PlateView::plan;
  p.points = {0, 0, 1, 0, 1, 1, 0, 1};
  p.triangles = {0, 1, 2, 0, 2, 3};
  p.deflection.assign(4, 0);
  const auto reaction = [](double x) { return 3 * x - 1; };
  for (int k = 0; k < 20; ++k) {
    PlateEdge e{{k / 20.0, 0}, {(k + 1) / 20.0, 0}, PlateSupport::held, false, {}};
    for (const double share : {0.0, 1.0}) {
      EdgeSample& s = e.samples.emplace_back();
      s.share = share, s.reaction = reaction((k + share) / 20);
    }
    p.boundary.push_back(e);
  }
  const Place corners[4] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
  EdgeSample begin, end;
  end.share = 1;
  for (int k = 0; k < 3; ++k) p.boundary.push_back({corners[k], corners[k + 1], PlateSupport::free, false, {begin, end}});
  p.supports = {{0.25, 0.75, 0, PlateSupport::held, std::nullopt}};
  p.forces = {{0.25, 0.75, -2}};
  const std::vector<DataMark> all = marks(p), up = of(all, "pushing", 2), down = of(all, "pulling", 2);
  REQUIRE(up.size() >= 3);
  REQUIRE(down.size() >= 2);
  const DataMark& most = *std::ranges::max_element(up, {}, size_of);
  const double scale = size_of(most) / reaction(most.at[0][0]);
  for (const auto* side : {&up, &down})
    for (const DataMark& o : *side) {
      CHECK(size_of(o) == doctest::Approx(scale * std::abs(reaction(o.at[0][0]))).epsilon(1e-3).scale(0.1));
      CHECK((reaction(o.at[0][0]) > -1e-9) == (side == &up));
      CHECK(o.at[1][1] <= o.at[0][1]);  // outside the lower edge
    }
  REQUIRE(of(all, "point support").size() == 1);
  CHECK(apart(of(all, "point support")[0].at[0], {0.25, 0.75}) < 1e-6);
  REQUIRE(of(all, "pulling", 1).size() == 1);
  CHECK(apart(of(all, "pulling", 1)[0].at[0], {0.25, 0.75}) < 1e-6);
}

TEST_CASE("curves of charts and beams go through what was given") {
  ChartPicture chart;
  chart.file = "curve.png", chart.log_y = true;
  SeriesPicture s;
  s.name = "decay";
  for (int k = 0; k <= 10; ++k) s.x.push_back(k), s.y.push_back(std::exp(-k));
  chart.series = {s};
  const std::vector<DataMark> drawn_markers = of(marks(chart), "markers: decay"), drawn_curve = of(marks(chart), "curve: decay");
  REQUIRE(drawn_markers.size() == 1);
  REQUIRE(drawn_markers[0].at.size() == s.x.size());
  REQUIRE(drawn_curve.size() == 1);
  for (std::size_t k = 0; k < s.x.size(); ++k) {
    CHECK(drawn_markers[0].at[k][0] == doctest::Approx(s.x[k]).scale(1));
    CHECK(drawn_markers[0].at[k][1] == doctest::Approx(s.y[k]));
  }
  for (const Place& p : drawn_curve[0].at) CHECK(std::log(p[1]) == doctest::Approx(-p[0]).scale(1));
  beam::Beam b;
  b.cells = 8;
  b.supports = {{"left", 0, test::kHeld, test::kHeld}};
  b.loads = {{1, -1, 0}};
  Monitor quiet;
  const auto solution = beam::solve(b, {}, quiet)[0].solution;
  PagePicture page = compose(view(*solution), {BeamPanel::deflection, BeamPanel::moment}, {});
  page.file = "beam.png";
  const std::vector<DataMark> all = marks(page), line = of(all, "beam"), moment = of(all, "curve");
  REQUIRE(line.size() == 1);
  for (const Place& p : line[0].at) CHECK(p[1] == doctest::Approx(solution->deflection(std::clamp(p[0], 0.0, 1.0))).scale(0.1));
  REQUIRE(moment.size() == 1);
  for (const Place& p : moment[0].at)
    if (p[0] > 1e-9) CHECK(std::abs(p[1]) == doctest::Approx(1 - p[0]).scale(1));
}

}  // namespace read_back
