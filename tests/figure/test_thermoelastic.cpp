// Pictures of thermoelastic beams: what is drawn is what was stepped, and without expansion what a plain beam shows.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../support/plain_laws.hpp"
#include "base/monitor.hpp"
#include "beam/solve.hpp"
#include "figure/compose/compose_beam.hpp"

using namespace dotyk;
using namespace dotyk::figure;
using problem::LawChoice;
using thermoelastic::Stepping;
namespace laws = dotyk::problem::laws;
using test::kFree;
using test::kHeld;

namespace {

const std::vector<BeamPanel> diagrams{BeamPanel::moment, BeamPanel::shear, BeamPanel::normal, BeamPanel::temperature, BeamPanel::gradient, BeamPanel::displacement};

const PageCurve& curve(const PagePicture& page, std::size_t row) { return std::get<CurveDrawing>(page.rows[row][0].drawing).curves[0]; }
const BeamDrawing& drawing(const PagePicture& page) { return std::get<BeamDrawing>(page.rows[0][0].drawing); }

struct Given {
  thermoelastic::Data data;
  thermoelastic::Loads loads;
  std::unique_ptr<Stepping> stepped(double time) const {
    Monitor quiet;
    auto s = std::make_unique<Stepping>(data, thermoelastic::Initial{}, thermoelastic::Scheme{0.1, thermoelastic::Order::two, true, {}}, loads, quiet);
    s->run(time, loads, quiet);
    return s;
  }
};

/// On supports of many kinds, warmed from above, loaded across and along.
Given warmed() {
  Given g;
  g.data.length = 2, g.data.E = 1e4, g.data.expansion = 1e-3, g.data.exchange_above = 2, g.data.exchange_below = 1;
  g.data.supports = {{"left", 0, {&laws::elastic, 40, 0}, {&laws::friction, 0.1, 0}, {&laws::signorini, 0, 0}},
                     {"x = 0.7", 0.7, {&laws::one_sided_elastic, 20, 0}, {&laws::elastic, 1, 0}, {}},
                     {"right", 2, {&laws::capped_elastic, 50, 0.5}, {&laws::one_sided_elastic, 3, 0}, {&laws::one_sided_elastic, 200, 0}}};
  g.loads.ambient_above.constant = 10, g.loads.transverse.constant = -2, g.loads.axial.constant = 3;
  return g;
}

void check_on_graph(const PagePicture& page) {
  const auto& reaction = std::get<CurveDrawing>(page.rows[0][0].drawing);
  REQUIRE(reaction.point);
  const auto [px, py] = *reaction.point;
  const double w = (*reaction.x_range)[1] - (*reaction.x_range)[0], h = (*reaction.y_range)[1] - (*reaction.y_range)[0];
  double least = 1;
  for (const PageCurve& c : reaction.curves)
    for (std::size_t i = 0; i + 1 < c.x.size(); ++i) {
      const double ax = (c.x[i] - px) / w, ay = (c.y[i] - py) / h, dx = (c.x[i + 1] - c.x[i]) / w, dy = (c.y[i + 1] - c.y[i]) / h;
      const double square = dx * dx + dy * dy, t = square > 0 ? std::clamp(-(ax * dx + ay * dy) / square, 0.0, 1.0) : 0;
      least = std::min(least, std::hypot(ax + t * dx, ay + t * dy));
    }
  CHECK(least <= 1e-8);  // the steps' contact problems are solved to 1e-10 of their data
}

}  // namespace

TEST_CASE("without expansion a thermoelastic beam and a plain one have the same picture") {
  for (const double q : {-1.0, 0.7}) {
    Given g = warmed();
    g.data.expansion = 0, g.data.supports[1].x = 1, g.loads.transverse.constant = q;
    g.data.supports.push_back(g.data.supports[2]);
    g.data.supports[2] = {"x = 1.5", 1.5, {&laws::load, -0.4, 0}, {&laws::load, 0.3, 0}, {}};
    const auto stepped = g.stepped(0.3);
    const Stepping& s = *stepped;
    beam::Beam b = thermoelastic::plain(g.data);
    b.EJ = g.data.E * thermoelastic::Coefficients(g.data).J, b.q = q;
    Monitor quiet;
    const auto branches = beam::solve(b, {}, quiet);
    const std::vector<BeamPanel> panels{BeamPanel::deflection, BeamPanel::moment, BeamPanel::shear};
    const PagePicture warm = compose(view(s, [&](double) { return q; }), panels, {}), plain = compose(view(*branches[0].solution), panels, {});
    const BeamDrawing &u = drawing(warm), &v = drawing(plain);
    REQUIRE(u.x == v.x);
    REQUIRE(u.supports.size() == v.supports.size());
    CHECK(u.loads.size() == v.loads.size());
    CHECK(u.load == v.load);
    // Both are exact at nodes but for rounding; condensed and not, it is of the order of 1e-10.
    for (std::size_t i = 0; i < u.x.size(); ++i) CHECK(u.deflection[i] == doctest::Approx(v.deflection[i]).epsilon(1e-7).scale(0.1));
    for (std::size_t i = 0; i < u.supports.size(); ++i) {
      CHECK(u.supports[i].below.kind == v.supports[i].below.kind);
      CHECK(u.supports[i].below.state == v.supports[i].below.state);
      CHECK(u.supports[i].arc.state == v.supports[i].arc.state);
      CHECK(u.supports[i].directed_arc == v.supports[i].directed_arc);
    }
    for (const std::size_t row : {1u, 2u}) {
      REQUIRE(curve(warm, row).x == curve(plain, row).x);
      for (std::size_t i = 0; i < curve(warm, row).x.size(); ++i) CHECK(curve(warm, row).y[i] == doctest::Approx(curve(plain, row).y[i]).epsilon(1e-7).scale(1));
    }
  }
}

TEST_CASE("diagrams of a thermoelastic beam are its state, forces within it from zero to zero") {
  const auto stepped = warmed().stepped(3);
  const Stepping& s = *stepped;
  const PagePicture page = compose(view(s, {}), diagrams, {});
  const std::vector<std::function<double(double)>> values{
      [&](double x) { return s.moment(x); }, [&](double x) { return s.shear(x); }, [&](double x) { return s.normal(x); },
      [&](double x) { return s.temperature(x); }, [&](double x) { return s.gradient(x); }, [&](double x) { return s.displacement(x); }};
  for (std::size_t row = 0; row < diagrams.size(); ++row) {
    const PageCurve& c = curve(page, row);
    CHECK(c.x.front() == 0);
    CHECK(c.x.back() == 2);
    if (row < 3) CHECK((c.y.front() == 0 && c.y.back() == 0));
    const auto [low, high] = std::minmax_element(c.y.begin(), c.y.end());
    CHECK(*high - *low > 0);
    for (std::size_t i = 1; i + 1 < c.x.size(); ++i)
      if (c.x[i + 1] != c.x[i] && c.x[i] > 0) CHECK(c.y[i] == values[row](c.x[i]));
  }
  // Left of the support at 0.7 the values are those that the cells there have.
  const auto at = std::find(curve(page, 1).x.begin(), curve(page, 1).x.end(), 0.7) - curve(page, 1).x.begin();
  for (const std::size_t row : {0u, 1u}) CHECK(curve(page, row).y[at] == doctest::Approx(values[row](0.7 * (1 - 1e-9))).epsilon(1e-6));
  CHECK(curve(page, 1).y[at] - curve(page, 1).y[at + 1] == doctest::Approx(s.reaction(1).force).epsilon(1e-9));
}

TEST_CASE("a support of a thermoelastic beam lies on the graph of its law, across, turning and along") {
  for (const double p : {3.0, -3.0})
    for (const double q : {-2.0, 1.0}) {
      Given g = warmed();
      g.loads.axial.constant = p, g.loads.transverse.constant = q;
      const auto s = g.stepped(2);
      const BeamView v = view(*s, {});
      for (const int support : {0, 1, 2})
        for (const LawSide of : {LawSide::deflection, LawSide::rotation, LawSide::displacement}) {
          CAPTURE(support);
          CAPTURE(static_cast<int>(of));
          check_on_graph(compose(v, support, of, {}));
        }
    }
}

TEST_CASE("what heat would cause but supports do not let it is not drawn as rounding leaves it") {
  Given g;
  g.data.E = 1e9, g.data.expansion = 1e-5, g.data.exchange_above = 2;
  g.data.supports = {{"left", 0, kHeld, kHeld, kHeld}, {"right", 1, kHeld, kHeld, kFree}};
  g.loads.ambient_above.constant = 100;
  const auto s = g.stepped(1);
  const PagePicture page = compose(view(*s, {}), {BeamPanel::deflection, BeamPanel::moment, BeamPanel::shear, BeamPanel::normal}, {});
  for (const double u : drawing(page).deflection) CHECK(u == 0);
  CHECK(curve(page, 1).y[1] != 0);
  for (const std::size_t row : {2u, 3u})
    for (const double y : curve(page, row).y) CHECK(y == 0);
}
