// Symbols of supports and arrows of loads.
#include "figure/canvas/axes.hpp"
#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour symbol_ink{40, 40, 40}, symbol_fill{255, 255, 255};
constexpr double support_size = 0.85, load_length = 2.6;  // em

// A frame at a boundary point: `out` away from the body, `along` its edge.
struct Local {
  Point at, out, along;
  double size;
  Point operator()(double s, double t) const { return at + size * (s * along + t * out); }
};

void ground(Canvas& c, const Local& l, double t, double width) {
  c.line(l(-0.6, t), l(0.6, t), width, symbol_ink);
  for (const double s : {-0.35, 0.0, 0.35, 0.6}) c.line(l(s, t), l(s - 0.25, t + 0.28), 0.7 * width, symbol_ink);
}

void triangle(Canvas& c, const Local& l, double base, double width) {
  const std::array<Point, 3> corners{l(0, 0), l(-0.45, base), l(0.45, base)};
  c.convex(corners, symbol_fill);
  c.polyline(corners, width, symbol_ink, {}, true);
}

void symbol(Canvas& c, SupportKind kind, const Local& l, double width, bool roller) {
  switch (kind) {
    case SupportKind::spring: {
      const std::array<Point, 7> zigzag{l(0, 0), l(0, 0.15), l(-0.25, 0.27), l(0.25, 0.47), l(-0.25, 0.67), l(0, 0.8), l(0, 0.95)};
      c.polyline(zigzag, width, symbol_ink);
      ground(c, l, 0.95, width);
      break;
    }
    case SupportKind::displace:
      c.arrow(l(0, 1.1), l(0, 0.08), 1.3 * width, 0.45 * l.size, symbol_ink);
      c.line(l(-0.45, 1.1), l(0.45, 1.1), width, symbol_ink);
      break;
    default:
      if (!roller) {
        triangle(c, l, 0.75, width);
        ground(c, l, 0.75, width);
        break;
      }
      triangle(c, l, 0.6, width);
      for (const double s : {-0.25, 0.25}) {
        c.disc(l(s, 0.77), 0.15 * l.size, symbol_ink);
        c.disc(l(s, 0.77), 0.15 * l.size - width, symbol_fill);
      }
      ground(c, l, 0.94, width);
  }
}

// A support that holds one direction only stands on rollers in that direction.
Local frame_of(const Stage& stage, const SupportSymbol& s, bool& roller) {
  Point out = stage.view.direction(s.normal);
  const int held = s.fixed[0] + s.fixed[1] + (stage.plane ? 0 : s.fixed[2]);
  roller = s.kind == SupportKind::slide || (s.kind == SupportKind::fix && held == 1);
  if (roller && s.kind == SupportKind::fix && stage.plane) {
    if (s.fixed[0]) out = {out.x >= 0.0 ? 1.0 : -1.0, 0};
    if (s.fixed[1]) out = {0, out.y > 1e-6 ? 1.0 : -1.0};
  }
  if (out.x == 0 && out.y == 0) out = {0, -1};
  return {stage.at(s), out, {-out.y, out.x}, support_size * stage.em};
}

// In the plane the symbols are those everyone knows; in space markers, which the legend names.
struct Kind {
  SupportKind kind;
  Marker marker;
  const char* name;
};
constexpr std::array kinds{Kind{SupportKind::fix, Marker::triangle, "fixed"}, Kind{SupportKind::slide, Marker::ring, "sliding"},
                           Kind{SupportKind::displace, Marker::diamond, "displacement given"}, Kind{SupportKind::spring, Marker::plus, "spring"}};

// In space those on the far side are hidden by the body.
std::vector<SupportSymbol> symbols_of(const Stage& stage, SupportKind kind) {
  std::vector<SupportSymbol> out;
  for (const SupportSymbol& s : stage.picture.supports)
    if (s.kind == kind && (stage.plane || (dot(s.normal, stage.view.towards) > 0 && stage.stays(s)))) out.push_back(s);
  return out;
}

void draw_support_symbols(Stage& stage, vtkRenderer*) {
  for (const Kind& kind : kinds) {
    const std::vector<SupportSymbol> symbols = symbols_of(stage, kind.kind);
    const std::vector<Point> at = stage.at(symbols);
    for (const std::size_t i : stage.spaced(at, (stage.plane ? 1.3 : 1.1) * support_size * stage.em)) {
      if (!stage.plane) {
        stage.over.marker(kind.marker, at[i], 0.45 * stage.em, symbol_ink);
        continue;
      }
      bool roller = false;
      const Local local = frame_of(stage, symbols[i], roller);
      symbol(stage.over, kind.kind, local, std::max(1.1, stage.em / 18), roller);
    }
  }
}

void support_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  for (const Kind& kind : kinds)
    if (stage.plane && kind.kind == SupportKind::spring && !symbols_of(stage, kind.kind).empty())
      out.push_back({kind.name, [em = stage.em, kind = kind.kind](Canvas& c, const Box& b) {
                       symbol(c, kind, {{b.centre().x, b.top - 0.05 * em}, {0, -1}, {1, 0}, std::min(support_size * em, 0.75 * b.height())}, std::max(1.1, em / 18), false);
                     }});
    else if (!stage.plane && !symbols_of(stage, kind.kind).empty())
      out.push_back({kind.name, [em = stage.em, marker = kind.marker](Canvas& c, const Box& b) { c.marker(marker, b.centre(), 0.45 * em, symbol_ink); }});
}

void support_bounds(const Stage& stage, Bounds& bounds) {
  if (!stage.plane) return;
  for (const SupportSymbol& s : stage.picture.supports) bounds.add(stage.at(s) + 1.35 * support_size * stage.em * stage.view.direction(s.normal));
}

// Where a load arrow begins and ends: pixels, the third towards the eye.
std::array<Vec3, 2> load_arrow_in_space(const Stage& stage, const LoadArrow& load) {
  const Vec3 at = stage.view.pixel(stage.place(load));
  if (!(stage.greatest_load > 0)) return {at, at};
  const double longest = load_length * stage.em / stage.greatest_load;
  const Vec3 along{longest * dot(load.vector, stage.view.right), longest * dot(load.vector, stage.view.up), longest * dot(load.vector, stage.view.towards)};
  // A load that pushes ends at the boundary, one that pulls begins there.
  const bool pushes = dot(load.normal, load.vector) <= 1e-9 * length(load.vector);
  return pushes ? std::array{plus(at, along, -1), at} : std::array{at, plus(at, along)};
}

Segment load_arrow(const Stage& stage, const LoadArrow& load) {
  const auto [tail, head] = load_arrow_in_space(stage, load);
  return {Point{tail[0], tail[1]}, Point{head[0], head[1]}};
}

void draw_loads(Stage& stage, vtkRenderer* renderer) {
  const double width = std::max(1.5, stage.em / 11), tip = 0.6 * stage.em;
  Arrows in_space(stage, width, tip);
  std::vector<Segment> drawn;
  for (const std::size_t i : stage.spaced(stage.at(stage.picture.loads), 0.95 * stage.em)) {
    const Segment arrow = load_arrow(stage, stage.picture.loads[i]);
    if (!stage.stays(stage.picture.loads[i])) continue;
    if (length(arrow[1] - arrow[0]) < 0.1 * stage.em) continue;
    // Along a boundary that is loaded along itself arrows would lie on each other.
    if (std::any_of(drawn.begin(), drawn.end(), [&](const Segment& other) { return distance(arrow, other) < 0.6 * stage.em; })) continue;
    drawn.push_back(arrow);
    if (stage.plane) {
      stage.over.arrow(arrow[0], arrow[1], width, tip, load_colour);
    } else {
      const auto [tail, head] = load_arrow_in_space(stage, stage.picture.loads[i]);
      in_space.add(tail, head);
    }
  }
  in_space.show(renderer, load_colour);
}

void load_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  const auto& loads = stage.picture.loads;
  const bool seen = std::any_of(loads.begin(), loads.end(), [&](const LoadArrow& load) { return stage.shows(stage.at(load)) && stage.stays(load); });
  if (!seen || !(stage.greatest_load > 0)) return;
  out.push_back({at_most("load", stage.greatest_load, stage.picture.load_unit), [em = stage.em](Canvas& c, const Box& b) {
                   c.arrow(b.midline()[0], b.midline()[1], std::max(1.5, em / 11), 0.6 * em, load_colour);
                 }});
}

void load_bounds(const Stage& stage, Bounds& bounds) {
  for (const LoadArrow& load : stage.picture.loads)
    for (const Point& end : load_arrow(stage, load)) bounds.add(end);
}

}  // namespace

Layer support_layer() { return {3, draw_support_symbols, support_legend, support_bounds}; }

Layer load_layer() { return {4, draw_loads, load_legend, load_bounds}; }

}  // namespace dotyk::figure
