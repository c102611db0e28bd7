#include "figure/compose_beam.hpp"

#include <algorithm>
#include <cmath>

#include "figure/compose_parts.hpp"

namespace dotyk::figure {

using beam::Solution;
using problem::SupportLaw;
using Kind = SupportLaw::Kind;

namespace {

constexpr int kPoints = 400;  // of a curve, at least

/// Where curves are taken: equal steps, the nodes, and the points where something acts.
std::vector<double> points(const Solution& s) {
  const double length = s.beam().length;
  std::vector<double> x = s.model().nodes;
  for (int i = 0; i <= kPoints; ++i) x.push_back(length * i / kPoints);
  for (const beam::PointLoad& load : s.beam().loads) x.push_back(load.x);
  for (double& v : x) v = std::clamp(v, 0.0, length);
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

ElementKind element_kind(Kind kind) {
  switch (kind) {
    case Kind::free:
    case Kind::load: return ElementKind::none;
    case Kind::prescribed: return ElementKind::fixed;
    case Kind::elastic: return ElementKind::spring;
    case Kind::one_sided_elastic: return ElementKind::plate_spring;
    case Kind::signorini: return ElementKind::stop;
    case Kind::friction: return ElementKind::slider;
    case Kind::one_sided_friction: return ElementKind::plate_slider;
    case Kind::capped_elastic: return ElementKind::capped_spring;
    case Kind::breaking: return ElementKind::breaking_spring;
  }
  return ElementKind::none;
}

/// With v and r as the law has them: one-sided ones push towards v > 0.
SupportState state(const SupportLaw& law, double v, double r, const Scales& scale) {
  const bool moved = std::abs(v) > kRounding * scale.displacement, pushes = r > kRounding * scale.force;
  switch (law.kind) {
    case Kind::one_sided_elastic:
    case Kind::signorini: return pushes ? SupportState::pushing : SupportState::open;
    case Kind::friction: return moved ? SupportState::slip : SupportState::stick;
    case Kind::one_sided_friction:
      if (moved) return v > 0 ? SupportState::open : SupportState::slip;
      return pushes ? SupportState::stick : SupportState::open;
    case Kind::capped_elastic: return std::abs(law.value * v) > law.limit ? SupportState::slip : SupportState::acting;
    case Kind::breaking:
      if (-law.value * v > law.limit) return SupportState::broken;
      return pushes ? SupportState::pushing : SupportState::open;
    default: return SupportState::acting;
  }
}

SupportElement element(const Solution& s, int support, LawSide of) {
  const SupportLaw& law = law_of(s, support, of);
  const WorkingPoint at = working_point(s, support, of);
  const double turn = turned(law, of) ? -1 : 1, v = turn * at.displacement;
  SupportElement out{element_kind(law.kind), state(law, v, turn * at.reaction, scales(s, of)), 0};
  const double yield = problem::yield_displacement(law);
  if (law.kind == Kind::capped_elastic && std::isfinite(yield)) out.slip = v - std::clamp(v, -yield, yield);
  return out;
}

/// All zero where it is what rounding left.
void clean(std::vector<double>& y, double scale) {
  double most = 0;
  for (const double v : y) most = std::max(most, std::abs(v));
  if (most <= kRounding * scale) std::fill(y.begin(), y.end(), 0.0);
}

/// M or T over x, from and back to zero at the ends; where it jumps both values.
PageCurve diagram(const Solution& s, BeamPanel panel) {
  const double length = s.beam().length, force = scales(s, LawSide::deflection).force;
  const auto value = [&](double x) { return panel == BeamPanel::moment ? s.moment(x) : s.shear(x); };
  PageCurve curve{{0}, {0}, false};
  const auto add = [&](double x, double y) { curve.x.push_back(x), curve.y.push_back(y); };
  std::vector<beam::PointLoad> acting = s.beam().loads;
  for (std::size_t i = 0; i < s.beam().supports.size(); ++i) {
    const beam::Reaction r = s.reaction(static_cast<int>(i));
    acting.push_back({s.model().nodes[s.model().supports[i].node], r.force, r.moment});
  }
  for (const double x : points(s)) {
    double jump = 0;  // the value to the right less that to the left
    for (const beam::PointLoad& load : acting)
      if (load.x == x && x > 0 && x < length) jump += panel == BeamPanel::moment ? load.moment : -load.force;
    if (jump != 0) add(x, value(x) - jump);
    add(x, value(x));
  }
  add(length, 0);
  clean(curve.y, panel == BeamPanel::moment ? force * length : force);
  return curve;
}

std::string unit_text(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + "·" + b; }

}  // namespace

BeamDrawing beam_drawing(const Solution& s) {
  BeamDrawing out;
  const beam::Beam& b = s.beam();
  out.length = b.length;
  out.x = points(s);
  for (const double x : out.x) {
    out.deflection.push_back(s.deflection(x));
    out.load.push_back(b.q_of ? b.q_of(x) : b.q);
  }
  if (std::all_of(out.load.begin(), out.load.end(), [](double q) { return q == 0; })) out.load.clear();
  for (const beam::PointLoad& load : b.loads) out.loads.push_back({load.x, load.force, load.moment});
  for (std::size_t i = 0; i < b.supports.size(); ++i) {
    const beam::Support& support = b.supports[i];
    const int index = static_cast<int>(i);
    const beam::Reaction r = s.reaction(index);
    out.supports.push_back({support.x, r.deflection, r.rotation, element(s, index, LawSide::deflection), element(s, index, LawSide::rotation),
                            problem::one_sided(support.rotation.kind)});
    const double force = support.deflection.kind == Kind::load ? support.deflection.value : 0;
    const double moment = support.rotation.kind == Kind::load ? support.rotation.value : 0;
    if (force != 0 || moment != 0) out.loads.push_back({support.x, force, moment});
  }
  return out;
}

PagePicture compose(const Solution& s, const std::vector<BeamPanel>& panels, const Units& units) {
  PagePicture page;
  page.shared_x = true;
  page.column_weights = {1};
  for (const BeamPanel panel : panels) {
    PageCell cell;
    cell.x_label = "x" + unit_text(units.length);
    if (panel == BeamPanel::deflection) {
      cell.y_label = "deflection u" + unit_text(units.length);
      cell.drawing = beam_drawing(s);
    } else {
      const bool moment = panel == BeamPanel::moment;
      cell.y_label = moment ? "moment M" + unit_text(joined(units.force, units.length)) : "shear force T" + unit_text(units.force);
      CurveDrawing curve;
      curve.curves = {diagram(s, panel)};
      curve.area = true;
      curve.colour = moment ? 0 : 2;
      cell.drawing = std::move(curve);
    }
    page.rows.push_back({std::move(cell)});
    page.row_weights.push_back(panel == BeamPanel::deflection ? 1.6 : 1);
  }
  return page;
}

}  // namespace dotyk::figure
