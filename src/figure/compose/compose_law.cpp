#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "figure/compose/compose_parts.hpp"

namespace dotyk::figure {

using problem::GraphWindow;
using problem::SupportLaw;
using Kind = SupportLaw::Kind;

namespace {

/// How far a graph reaches: a little beyond all that happens on it. `least`, `most`: also where r would be without end.
GraphWindow window(const SupportLaw& law, const std::optional<WorkingPoint>& at, const Scales& scale) {
  const double yield = problem::yield_displacement(law);
  double v = at ? std::abs(at->displacement) : 0, r = at ? std::abs(at->reaction) : 0;
  if (std::isfinite(yield)) v = std::max(v, yield);
  if (law.kind == Kind::prescribed) v = std::max(v, std::abs(law.value));
  if (!(v > kRounding * scale.displacement)) v = scale.displacement;
  const bool spring = law.kind == Kind::elastic || law.kind == Kind::one_sided_elastic || law.kind == Kind::unequal_elastic;
  const bool bounded = law.kind == Kind::friction || law.kind == Kind::one_sided_friction || law.kind == Kind::load;
  r = std::max({r, spring ? std::max(law.value, law.pull) * v : 0, bounded ? std::abs(law.value) : 0, law.limit});
  if (!(r > kRounding * scale.force)) r = bounded || spring || law.limit > 0 ? std::max(r, std::numeric_limits<double>::min()) : scale.force;
  if (spring) r *= 1.1;
  const bool up = problem::one_sided(law.kind);
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
std::vector<PageCell> law_cells(const SupportLaw& law, LawSide of, bool turned, const std::optional<WorkingPoint>& at, const Scales& scale, const Units& units) {
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
  return law_cells(at.law, of, at.turned, working_point(at, scale), scale, units);
}

PagePicture law_page(std::vector<PageCell> cells) {
  PagePicture page;
  page.width = 1100, page.height = 480;
  page.column_weights = {1, 1}, page.row_weights = {1};
  page.rows = {std::move(cells)};
  return page;
}

}  // namespace

WorkingPoint working_point(const ViewedLaw& at, const Scales& scale) {
  const auto clean = [](double value, double size) { return std::abs(value) > kRounding * size ? value : 0; };
  return {clean(at.displacement - at.place, scale.displacement), clean(at.reaction - at.force, scale.force)};
}

PagePicture compose(const SupportLaw& law, LawSide of, const Units& units) { return law_page(law_cells(law, of, turned(law, of), std::nullopt, {}, units)); }

PagePicture compose(const BeamView& view, int support, LawSide of, const Units& units) {
  PagePicture page = law_page(law_cells(view, support, of, units));
  page.rows.front().front().title = view.doubt;
  return page;
}

PagePicture compose(const std::vector<GalleryRow>& rows) {
  PagePicture page;
  page.width = 1600, page.height = 60 + 380 * static_cast<int>(rows.size());
  page.column_weights = {1.55, 1, 1};
  for (const GalleryRow& row : rows) {
    PageCell beam;
    beam.title = row.title + (row.title.empty() || row.view.doubt.empty() ? "" : ", ") + row.view.doubt;
    beam.x_label = "x", beam.y_label = "deflection u";
    beam.drawing = beam_drawing(row.view);
    std::vector<PageCell> cells = law_cells(row.view, row.support, row.of, {});
    cells.insert(cells.begin(), std::move(beam));
    page.rows.push_back(std::move(cells));
    page.row_weights.push_back(1);
  }
  return page;
}

}  // namespace dotyk::figure
