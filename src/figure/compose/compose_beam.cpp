#include "figure/compose/compose_beam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "figure/canvas/plane.hpp"
#include "problem/support_graph.hpp"

namespace dotyk::figure {

using problem::GraphWindow;
using problem::LawChoice;

namespace {

constexpr int kPoints = 400;  // of a curve, at least

// " [N]" after the name of a quantity; nothing where units are not given.
std::string unit_text(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

// "N·m"; one alone where the other is not given.
std::string joined(const std::string& a, const char* sign, const std::string& b) { return a.empty() || b.empty() ? a + b : a + sign + b; }

// Where a support is on its law; zero where it is what rounding left.
struct WorkingPoint {
  double displacement, reaction;  // u and force, u' and moment, or u₁ and axial force
};

WorkingPoint working_point(const ViewedLaw& at, const Scales& scale) {
  const auto clean = [](double value, double size) { return std::abs(value) > kRounding * size ? value : 0; };
  return {clean(at.displacement - at.place, scale.displacement), clean(at.reaction - at.force, scale.force)};
}

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

ElementKind element_kind(const problem::LawTraits& law) {
  if (!law.acts() || law.load || law.follows) return ElementKind::none;
  if (law.breaks) return ElementKind::breaking_spring;
  if (law.rigid && law.bounded) return law.pulls ? ElementKind::slider : ElementKind::plate_slider;
  if (law.rigid) return law.pulls ? ElementKind::fixed : ElementKind::stop;
  if (law.uneven) return ElementKind::paired_springs;
  return law.bounded ? ElementKind::capped_spring : law.pulls ? ElementKind::spring : ElementKind::plate_spring;
}

/// With v and r as the law has them: one-sided ones push towards v > 0.
SupportState state(const LawChoice& law, double v, double r, const Scales& scale) {
  const bool moved = std::abs(v) > kRounding * scale.displacement, pushes = r > kRounding * scale.force;
  if (law->breaks && !pushes) return moved && v < 0 ? SupportState::broken : SupportState::open;
  if (law->rubs()) return moved ? SupportState::slip : SupportState::stick;
  if (law->rigid && law->bounded && moved) return v > 0 ? SupportState::open : SupportState::slip;
  if (law->rigid && law->bounded) return pushes ? SupportState::stick : SupportState::open;
  if (law->yields()) return std::abs(v) > problem::yield_displacement(law) ? SupportState::slip : SupportState::acting;
  if (law->one_sided()) return pushes ? SupportState::pushing : SupportState::open;
  if (!law->uneven) return SupportState::acting;
  if (std::abs(r) > kRounding * scale.force) return pushes ? SupportState::pushing : SupportState::pulling;
  return moved ? SupportState::open : SupportState::acting;
}

SupportElement element(const ViewedLaw& at, const Scales& scale) {
  const double turn = at.turned ? -1 : 1;
  const WorkingPoint w = working_point(at, scale);
  const double v = turn * w.displacement;
  SupportElement out{element_kind(at.law.spec->traits), state(at.law, v, turn * w.reaction, scale), 0};
  const double yield = problem::yield_displacement(at.law);
  if (at.law->yields() && std::isfinite(yield)) out.slip = v - std::clamp(v, -yield, yield);
  return out;
}

/// All zero where it is what rounding left.
void clean(std::vector<double>& y, double scale) {
  if (greatest(y) <= kRounding * scale) std::fill(y.begin(), y.end(), 0.0);
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

BeamDrawing beam_drawing(const BeamView& view, const Units& units) {
  BeamDrawing out;
  out.force_unit = units.force, out.moment_unit = joined(units.force, "·", units.length);
  if (!units.force.empty() && !units.length.empty()) out.load_unit = units.force + "/" + units.length;
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
                            s.deflection.place, s.rotation.place, element(s.deflection, bending), element(s.rotation, turning), s.rotation.law->directed()});
    const double force = s.deflection.force + s.deflection.law.force();
    const double moment = s.rotation.force + s.rotation.law.force();
    if (force != 0 || moment != 0) out.loads.push_back({s.x, force, moment});
  }
  return out;
}

/// How far a graph reaches: a little beyond all that happens on it. `least`, `most`: also where r would be without end.
GraphWindow window(const LawChoice& law, const std::optional<WorkingPoint>& at, const Scales& scale) {
  const double yield = problem::yield_displacement(law);
  double v = at ? std::abs(at->displacement) : 0, r = at ? std::abs(at->reaction) : 0;
  if (std::isfinite(yield)) v = std::max(v, yield);
  v = std::max(v, std::abs(law.displacement()));
  if (!(v > kRounding * scale.displacement)) v = scale.displacement;
  const bool spring = law->elastic() && !law->bounded;
  const double bound = law->bounded ? law.bound() : std::abs(law.force());
  r = std::max(r, bound);
  if (spring)
    for (const double at : {-v, v}) r = std::max(r, std::abs(problem::row_law(law)->respond(0, at).force));
  if (!(r > kRounding * scale.force)) r = spring || bound > 0 || law->rigid == law->bounded ? std::max(r, std::numeric_limits<double>::min()) : scale.force;
  if (spring) r *= 1.1;
  const bool up = law->one_sided();
  return {-1.6 * v, 1.6 * v, (up ? -0.45 : -1.6) * r, 1.6 * r};
}

CurveDrawing turn(CurveDrawing c, double x, double y) {
  const auto flip = [](std::array<double, 2> range, double by) {
    return by < 0 ? std::array<double, 2>{-range[1], -range[0]} : range;
  };
  for (PageCurve& curve : c.curves) {
    for (double& v : curve.x) v *= x;
    for (double& v : curve.y) v *= y;
  }
  for (auto& range : c.forbidden) range = flip(range, x);
  c.x_range = flip(*c.x_range, x), c.y_range = flip(*c.y_range, y);
  return c;
}

CurveDrawing reaction_drawing(const problem::SupportGraph& graph, const GraphWindow& w) {
  CurveDrawing out;
  for (const problem::Curve& piece : graph.reaction) out.curves.push_back({piece.x, piece.y, false});
  for (const problem::Curve& jump : graph.jumps) out.curves.push_back({jump.x, jump.y, true});
  out.x_range = {w.low, w.high}, out.y_range = {w.least, w.most};
  if (graph.low > w.low) out.forbidden.push_back({w.low, graph.low});
  if (graph.high < w.high) out.forbidden.push_back({graph.high, w.high});
  return out;
}

CurveDrawing energy_drawing(const problem::SupportGraph& graph, const GraphWindow& w) {
  CurveDrawing out = reaction_drawing(graph, w);
  const auto [least, most] = std::minmax_element(graph.energy.y.begin(), graph.energy.y.end());
  if (!std::isfinite(w.high - w.low) || !std::isfinite(w.most - w.least) || !std::isfinite(1.35 * *most) || !std::isfinite(1.35 * *least))
    throw InputError("the law goes beyond the range of numbers; choose units in which its numbers are moderate");
  const double size = std::max(*most, -*least) > 0 ? std::max(*most, -*least) : 1;
  const double bottom = *least < 0 ? -1.35 * size : -0.15 * size, top = 1.35 * size;
  PageCurve curve{graph.energy.x, graph.energy.y, false};
  // Up to infinity where the law ends.
  if (graph.low > w.low) curve.x.insert(curve.x.begin(), graph.low), curve.y.insert(curve.y.begin(), top);
  if (graph.high < w.high) curve.x.push_back(graph.high), curve.y.push_back(top);
  out.curves = {curve};
  out.colour = 2;
  out.no_scale = *most == 0 && *least == 0;
  out.y_range = {bottom, top};
  return out;
}

/// Graph and superpotential.
std::vector<PageCell> law_cells(const LawChoice& law, LawSide of, bool turned, const std::optional<WorkingPoint>& at, const Scales& scale, const Units& units) {
  const double sign = turned ? -1 : 1;
  const GraphWindow w = window(law, at, scale);
  const problem::SupportGraph graph = problem::graph(law, w);
  const std::string moment = joined(units.force, "·", units.length);
  std::vector<PageCell> cells(2);
  CurveDrawing reaction = turn(reaction_drawing(graph, w), sign, sign), energy = turn(energy_drawing(graph, w), sign, 1);
  if (at) {
    reaction.point = {at->displacement, at->reaction};
    const double v = sign * at->displacement;
    energy.point = {at->displacement, problem::energy(law, std::clamp(v, graph.low, graph.high))};
  }
  std::string x = "deflection u" + unit_text(units.length), y = "reaction" + unit_text(units.force);
  if (of == LawSide::rotation) x = "rotation u′" + unit_text(units.length.empty() ? "" : "rad"), y = "reaction moment" + unit_text(moment);
  if (of == LawSide::displacement) x = "displacement u₁" + unit_text(units.length), y = "axial reaction" + unit_text(units.force);
  cells[0].x_label = cells[1].x_label = x;
  cells[0].y_label = y, cells[1].y_label = "superpotential" + unit_text(moment);
  cells[0].drawing = std::move(reaction), cells[1].drawing = std::move(energy);
  return cells;
}

std::vector<PageCell> law_cells(const BeamView& view, int support, LawSide of, const Units& units) {
  const ViewedLaw& at = view.supports[static_cast<std::size_t>(support)].of(of);
  const Scales scale = scales(view, of);
  std::vector<PageCell> cells = law_cells(at.law, of, at.turned, working_point(at, scale), scale, units);
  for (PageCell& cell : cells) std::get<CurveDrawing>(cell.drawing).state = element(at, scale).state;
  return cells;
}

PagePicture law_page(std::vector<PageCell> cells) {
  PagePicture page;
  page.width = 1100, page.height = 480;
  page.column_weights = {1, 1}, page.row_weights = {1};
  page.rows = {std::move(cells)};
  return page;
}

}  // namespace

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
      cell.drawing = beam_drawing(view, units);
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

PagePicture compose(const LawChoice& law, LawSide of, const Units& units) { return law_page(law_cells(law, of, turned(law, of), std::nullopt, {}, units)); }

PagePicture compose(const BeamView& view, int support, LawSide of, const Units& units) {
  PagePicture page = law_page(law_cells(view, support, of, units));
  page.rows.front().front().title = view.doubt;
  return page;
}

PagePicture compose(const std::vector<GalleryRow>& rows) {
  PagePicture page;
  page.width = 1600, page.height = 60 + std::min(380 * static_cast<int>(rows.size()), 1735);  // 200 mm
  page.column_weights = {1.55, 1, 1};
  for (const GalleryRow& row : rows) {
    PageCell beam;
    beam.title = row.title + (row.title.empty() || row.view.doubt.empty() ? "" : ", ") + row.view.doubt;
    beam.x_label = "x", beam.y_label = "deflection u";
    beam.drawing = beam_drawing(row.view, {});
    std::vector<PageCell> cells = law_cells(row.view, row.support, row.of, {});
    cells.insert(cells.begin(), std::move(beam));
    page.rows.push_back(std::move(cells));
    page.row_weights.push_back(1);
  }
  return page;
}

}  // namespace dotyk::figure
