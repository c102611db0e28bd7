// Symbols of supports and arrows of loads.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour symbol_ink{40, 40, 40}, symbol_fill{255, 255, 255};

// A frame at a boundary point: `out` away from the body, `along` its edge.
struct Local {
  Point at, out, along;
  double size;
  Point operator()(double s, double t) const {
    return {at.x + size * (s * along.x + t * out.x), at.y + size * (s * along.y + t * out.y)};
  }
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
  return {stage.view.flat(stage.deformed(s.position, s.displacement)), out, {-out.y, out.x}, support_size * stage.em};
}

Marker space_marker(SupportKind kind) {
  switch (kind) {
    case SupportKind::fix: return Marker::triangle;
    case SupportKind::slide: return Marker::ring;
    case SupportKind::displace: return Marker::diamond;
    case SupportKind::spring: return Marker::plus;
  }
  return Marker::disc;
}

const char* support_name(SupportKind kind) {
  switch (kind) {
    case SupportKind::fix: return "fixed";
    case SupportKind::slide: return "sliding";
    case SupportKind::displace: return "displacement given";
    case SupportKind::spring: return "spring";
  }
  return "";
}

}  // namespace

void draw_supports(Stage& stage) {
  const double width = std::max(1.1, stage.em / 18);
  for (const SupportKind kind : {SupportKind::fix, SupportKind::slide, SupportKind::displace, SupportKind::spring}) {
    std::vector<const SupportSymbol*> symbols;
    std::vector<Point> at;
    for (const SupportSymbol& s : stage.picture.supports) {
      // In space those on the far side are hidden by the body.
      if (s.kind != kind || (!stage.plane && dot(s.normal, stage.view.towards) <= 0)) continue;
      symbols.push_back(&s);
      at.push_back(stage.view.flat(stage.deformed(s.position, s.displacement)));
    }
    for (const std::size_t i : stage.spaced(at, (stage.plane ? 1.3 : 1.1) * support_size * stage.em)) {
      if (!stage.plane) {
        stage.over.marker(space_marker(kind), at[i], 0.45 * stage.em, symbol_ink);
        continue;
      }
      bool roller = false;
      const Local local = frame_of(stage, *symbols[i], roller);
      symbol(stage.over, kind, local, width, roller);
    }
  }
}

double greatest_load(const ScenePicture& picture) {
  double greatest = 0;
  for (const LoadArrow& load : picture.loads) greatest = std::max(greatest, std::sqrt(dot(load.vector, load.vector)));
  return greatest;
}

std::array<Point, 2> load_arrow(const Stage& stage, const LoadArrow& load, double greatest) {
  const Point at = stage.view.flat(stage.deformed(load.position, load.displacement));
  if (!(greatest > 0)) return {at, at};
  const double scale = load_length * stage.em / greatest;
  const Point along{scale * dot(load.vector, stage.view.right), scale * dot(load.vector, stage.view.up)};
  // A load that pushes ends at the boundary, one that pulls begins there.
  bool pushes = true;
  for (const auto& [least, most] : stage.body_boxes) {
    const double slack = 1e-6 * std::sqrt(dot(plus(most, least, -1), plus(most, least, -1)));
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) inside = inside && load.position[c] >= least[c] - slack && load.position[c] <= most[c] + slack;
    if (!inside) continue;
    const Vec3 centre = plus(plus(least, most), plus(least, most), -0.5);
    pushes = dot(plus(centre, load.position, -1), load.vector) >= 0;
    break;
  }
  if (pushes) return {Point{at.x - along.x, at.y - along.y}, at};
  return {at, Point{at.x + along.x, at.y + along.y}};
}

namespace {

double distance(const std::array<Point, 2>& segment, Point p) {
  const Point along{segment[1].x - segment[0].x, segment[1].y - segment[0].y};
  const double square = along.x * along.x + along.y * along.y;
  const double share = square > 0 ? ((p.x - segment[0].x) * along.x + (p.y - segment[0].y) * along.y) / square : 0;
  const double s = std::clamp(share, 0.0, 1.0);
  return std::hypot(p.x - segment[0].x - s * along.x, p.y - segment[0].y - s * along.y);
}

// Between arrows that do not cross.
double distance(const std::array<Point, 2>& a, const std::array<Point, 2>& b) {
  return std::min({distance(a, b[0]), distance(a, b[1]), distance(b, a[0]), distance(b, a[1])});
}

}  // namespace

void draw_loads(Stage& stage) {
  const double greatest = greatest_load(stage.picture);
  std::vector<Point> at;
  for (const LoadArrow& load : stage.picture.loads) at.push_back(stage.view.flat(stage.deformed(load.position, load.displacement)));
  std::vector<std::array<Point, 2>> drawn;
  for (const std::size_t i : stage.spaced(at, 0.95 * stage.em)) {
    const auto arrow = load_arrow(stage, stage.picture.loads[i], greatest);
    const auto& [tail, head] = arrow;
    if (std::hypot(head.x - tail.x, head.y - tail.y) < 0.1 * stage.em) continue;
    // Along a boundary that is loaded along itself arrows would lie on each other.
    const auto on = [&](const auto& other) { return distance(arrow, other) < 0.6 * stage.em; };
    if (std::any_of(drawn.begin(), drawn.end(), on)) continue;
    drawn.push_back(arrow);
    stage.over.arrow(tail, head, std::max(1.5, stage.em / 11), 0.6 * stage.em, load_colour);
  }
}

std::vector<LegendEntry> support_legend(const Stage& stage) {
  std::vector<LegendEntry> out;
  const double em = stage.em;
  const bool loads = std::any_of(stage.picture.loads.begin(), stage.picture.loads.end(), [&](const LoadArrow& load) {
    return stage.shows(stage.view.flat(stage.deformed(load.position, load.displacement)));
  });
  if (loads && greatest_load(stage.picture) > 0)
    out.push_back({"load", [em](Canvas& c, const Box& b) {
                     const double middle = (b.bottom + b.top) / 2;
                     c.arrow({b.left, middle}, {b.right, middle}, std::max(1.5, em / 11), 0.6 * em, load_colour);
                   }});
  // In the plane the symbols are those everyone knows.
  if (stage.plane) return out;
  for (const SupportKind kind : {SupportKind::fix, SupportKind::slide, SupportKind::displace, SupportKind::spring}) {
    const bool seen = std::any_of(stage.picture.supports.begin(), stage.picture.supports.end(),
                                  [&](const SupportSymbol& s) { return s.kind == kind && dot(s.normal, stage.view.towards) > 0; });
    if (seen)
      out.push_back({support_name(kind), [em, kind](Canvas& c, const Box& b) {
                       c.marker(space_marker(kind), {(b.left + b.right) / 2, (b.bottom + b.top) / 2}, 0.45 * em, symbol_ink);
                     }});
  }
  return out;
}

}  // namespace dotyk::figure
