#include "figure/compose/compose_beam.hpp"

#include <algorithm>
#include <cmath>

#include "figure/compose/compose_parts.hpp"

namespace dotyk::figure {

using problem::SupportLaw;
using Kind = SupportLaw::Kind;

namespace {

constexpr int kPoints = 400;  // of a curve, at least

/// Where curves are taken: equal steps, the nodes, and the points where something acts.
std::vector<double> points(const BeamView& view) {
  std::vector<double> x = view.nodes;
  for (int i = 0; i <= kPoints; ++i) x.push_back(view.length * i / kPoints);
  for (const BeamLoad& load : view.loads) x.push_back(load.x);
  for (double& v : x) v = std::clamp(v, 0.0, view.length);
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

ElementKind element_kind(Kind kind) {
  switch (kind) {
    case Kind::free:
    case Kind::load:
    case Kind::coulomb: return ElementKind::none;
    case Kind::prescribed: return ElementKind::fixed;
    case Kind::elastic: return ElementKind::spring;
    case Kind::one_sided_elastic:
    case Kind::compliance: return ElementKind::plate_spring;
    case Kind::signorini: return ElementKind::stop;
    case Kind::friction: return ElementKind::slider;
    case Kind::one_sided_friction: return ElementKind::plate_slider;
    case Kind::capped_elastic: return ElementKind::capped_spring;
    case Kind::unequal_elastic: return ElementKind::paired_springs;
    case Kind::breaking: return ElementKind::breaking_spring;
  }
  return ElementKind::none;
}

/// With v and r as the law has them: one-sided ones push towards v > 0.
SupportState state(const SupportLaw& law, double v, double r, const Scales& scale) {
  const bool moved = std::abs(v) > kRounding * scale.displacement, pushes = r > kRounding * scale.force;
  switch (law.kind) {
    case Kind::one_sided_elastic:
    case Kind::compliance:
    case Kind::signorini: return pushes ? SupportState::pushing : SupportState::open;
    case Kind::friction: return moved ? SupportState::slip : SupportState::stick;
    case Kind::one_sided_friction:
      if (moved) return v > 0 ? SupportState::open : SupportState::slip;
      return pushes ? SupportState::stick : SupportState::open;
    case Kind::capped_elastic: return std::abs(law.value * v) > law.limit ? SupportState::slip : SupportState::acting;
    case Kind::unequal_elastic:
      if (std::abs(r) > kRounding * scale.force) return pushes ? SupportState::pushing : SupportState::pulling;
      return moved ? SupportState::open : SupportState::acting;
    case Kind::breaking:
      if (pushes) return SupportState::pushing;
      return moved && v < 0 ? SupportState::broken : SupportState::open;
    case Kind::free:
    case Kind::prescribed:
    case Kind::load:
    case Kind::coulomb:
    case Kind::elastic: break;
  }
  return SupportState::acting;
}

SupportElement element(const ViewedLaw& at, const Scales& scale) {
  const double turn = at.turned ? -1 : 1;
  const WorkingPoint w = working_point(at, scale);
  const double v = turn * w.displacement;
  SupportElement out{element_kind(at.law.kind), state(at.law, v, turn * w.reaction, scale), 0};
  const double yield = problem::yield_displacement(at.law);
  if (at.law.kind == Kind::capped_elastic && std::isfinite(yield)) out.slip = v - std::clamp(v, -yield, yield);
  return out;
}

/// All zero where it is what rounding left.
void clean(std::vector<double>& y, double scale) {
  double most = 0;
  for (const double v : y) most = std::max(most, std::abs(v));
  if (most <= kRounding * scale) std::fill(y.begin(), y.end(), 0.0);
}

/// Forces and moments within a beam come from zero at one end and go back to it at the other.
bool closes(BeamPanel panel) { return panel == BeamPanel::moment || panel == BeamPanel::shear || panel == BeamPanel::normal; }

/// Over x; where it jumps both values.
PageCurve curve_of(const BeamView& view, BeamPanel panel) {
  const Diagram& diagram = view.diagrams.at(panel);
  PageCurve curve;
  const auto add = [&](double x, double y) { curve.x.push_back(x), curve.y.push_back(y); };
  if (closes(panel)) add(0, 0);
  for (const double x : points(view)) {
    double jump = 0;  // the value to the right less that to the left
    for (const Diagram::Jump& j : diagram.jumps)
      if (j.x == x && x > 0 && x < view.length) jump += j.by;
    const double y = diagram.value(x);
    if (jump != 0) add(x, y - jump);
    add(x, y);
  }
  if (closes(panel)) add(view.length, 0);
  clean(curve.y, diagram.scale);
  return curve;
}

struct PanelStyle {
  std::string label;
  int colour;
};

PanelStyle style(BeamPanel panel, const Units& units) {
  switch (panel) {
    case BeamPanel::deflection: return {"deflection u" + unit_text(units.length), 0};
    case BeamPanel::moment: return {"moment M" + unit_text(joined(units.force, "·", units.length)), 0};
    case BeamPanel::shear: return {"shear force T" + unit_text(units.force), 2};
    case BeamPanel::normal: return {"normal force N" + unit_text(units.force), 4};
    case BeamPanel::temperature: return {"temperature ϑ₁" + unit_text(units.temperature), 1};
    case BeamPanel::gradient: return {"gradient ϑ₂" + unit_text(units.temperature.empty() || units.length.empty() ? "" : units.temperature + "/" + units.length), 3};
    case BeamPanel::displacement: return {"displacement u₁" + unit_text(units.length), 5};
  }
  return {};
}

}  // namespace

BeamDrawing beam_drawing(const BeamView& view) {
  BeamDrawing out;
  out.length = view.length;
  out.x = points(view);
  for (const double x : out.x) {
    out.deflection.push_back(view.deflection(x));
    out.load.push_back(view.load ? view.load(x) : 0);
  }
  clean(out.deflection, view.bending.displacement);
  if (std::all_of(out.load.begin(), out.load.end(), [](double q) { return q == 0; })) out.load.clear();
  out.loads = view.loads;
  for (const ViewedSupport& s : view.supports) {
    const Scales bending = scales(view, LawSide::deflection), turning = scales(view, LawSide::rotation);
    out.supports.push_back({s.x, s.deflection.place + working_point(s.deflection, bending).displacement, s.rotation.place + working_point(s.rotation, turning).displacement,
                            element(s.deflection, bending), element(s.rotation, turning), problem::directed(s.rotation.law.kind)});
    const double force = s.deflection.force + (s.deflection.law.kind == Kind::load ? s.deflection.law.value : 0);
    const double moment = s.rotation.force + (s.rotation.law.kind == Kind::load ? s.rotation.law.value : 0);
    if (force != 0 || moment != 0) out.loads.push_back({s.x, force, moment});
  }
  return out;
}

PagePicture compose(const BeamView& view, const std::vector<BeamPanel>& panels, const Units& units) {
  PagePicture page;
  page.shared_x = true;
  page.column_weights = {1};
  for (const BeamPanel panel : panels) {
    const auto [label, colour] = style(panel, units);
    PageCell cell;
    cell.x_label = "x" + unit_text(units.length);
    cell.y_label = label;
    if (panel == BeamPanel::deflection) {
      cell.drawing = beam_drawing(view);
    } else {
      CurveDrawing curve;
      curve.curves = {curve_of(view, panel)};
      curve.area = true;
      curve.colour = colour;
      cell.drawing = std::move(curve);
    }
    page.rows.push_back({std::move(cell)});
    page.row_weights.push_back(panel == BeamPanel::deflection ? 1.6 : 1);
  }
  double weight = 0;
  for (const double w : page.row_weights) weight += w;
  page.height = 60 + static_cast<int>(std::lround(250 * weight));
  page.rows.front().front().title = view.doubt;
  return page;
}

}  // namespace dotyk::figure
