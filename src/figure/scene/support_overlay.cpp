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

void ground(Canvas& c, const Local& l, double t, double width, Colour ink) {
  c.line(l(-0.6, t), l(0.6, t), width, ink);
  for (const double s : {-0.35, 0.0, 0.35, 0.6}) c.line(l(s, t), l(s - 0.25, t + 0.28), 0.7 * width, ink);
}

void triangle(Canvas& c, const Local& l, double base, double width, Colour ink) {
  const std::array<Point, 3> corners{l(0, 0), l(-0.45, base), l(0.45, base)};
  c.convex(corners, symbol_fill);
  c.polyline(corners, width, ink, {}, true);
}

// A spring goes from `end`, which is 0 at rest, to the ground, `depth` from there.
void symbol(Canvas& c, SupportKind kind, const Local& l, double width, bool roller, Colour ink, Point end, double depth) {
  switch (kind) {
    case SupportKind::spring: {
      const auto at = [&](double s, double share) { return l((1 - share) * end.x + s, end.y + share * (depth - end.y)); };
      const std::array<Point, 7> zigzag{at(0, 0), at(0, 0.16), at(-0.25, 0.28), at(0.25, 0.5), at(-0.25, 0.7), at(0, 0.84), at(0, 1)};
      c.polyline(zigzag, width, ink);
      ground(c, l, depth, width, ink);
      break;
    }
    case SupportKind::displace:
      c.arrow(l(0, 1.1), l(0, 0.08), 1.3 * width, 0.45 * l.size, ink);
      c.line(l(-0.45, 1.1), l(0.45, 1.1), width, ink);
      break;
    default:
      triangle(c, l, roller ? 0.6 : 0.75, width, ink);
      for (const double s : {-0.25, 0.25}) {
        if (!roller) continue;
        c.disc(l(s, 0.77), 0.15 * l.size, ink);
        c.disc(l(s, 0.77), 0.15 * l.size - width, symbol_fill);
      }
      ground(c, l, roller ? 0.94 : 0.75, width, ink);
  }
}

constexpr double rest = 0.95;  // of a spring, of a symbol's size

// How far from the body at rest the grounds of springs are, all alike: none is reached by what is drawn of the body.
double spring_depth(const Stage& stage) {
  double most = 0;
  for (const SupportSymbol& s : stage.picture.supports)
    if (s.kind == SupportKind::spring && !s.open) most = std::max(most, stage.picture.deformation * dot(s.displacement, s.normal));
  return rest + stage.view.scale * most / (support_size * stage.em);
}

// Where a support holds the body: a spring's and what does not act at rest, others as it is displaced.
Point foot(const Stage& stage, const SupportSymbol& s) { return s.kind == SupportKind::spring || s.open ? stage.view.flat(s.position) : stage.at(s); }

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
  return {foot(stage, s), out, {-out.y, out.x}, support_size * stage.em};
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

// Stretches of the boundary whose neighbours follow each other: numbers of the first and of the one after the last.
template <class Thing>
std::vector<std::pair<std::size_t, std::size_t>> stretches_of(const std::vector<Thing>& things) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t first = 0, next = 0; first < things.size(); first = next) {
    while (++next < things.size() && things[next].place - things[next - 1].place <= 2 && things[next].place >= things[next - 1].place) {}
    out.emplace_back(first, next);
  }
  return out;
}

// Numbers of those that are drawn: along each stretch of the boundary some `spacing` apart, clear of those of others.
template <class Thing>
std::vector<std::size_t> chosen(const Stage& stage, const std::vector<Thing>& things, double spacing) {
  std::vector<std::size_t> out;
  const std::vector<Point> at = stage.at(things);
  for (const auto& [first, next] : stretches_of(things))
    for (const std::size_t k : stage.spaced({at.begin() + static_cast<std::ptrdiff_t>(first), at.begin() + static_cast<std::ptrdiff_t>(next)}, spacing))
      if (std::ranges::none_of(out, [&](std::size_t i) { return length(at[i] - at[first + k]) < 0.7 * spacing; })) out.push_back(first + k);
  return out;
}

void draw_support_symbols(Stage& stage, vtkRenderer*) {
  for (const Kind& kind : kinds) {
    const std::vector<SupportSymbol> symbols = symbols_of(stage, kind.kind);
    for (const std::size_t i : chosen(stage, symbols, (stage.plane ? 1.3 : 1.1) * support_size * stage.em)) {
      const SupportSymbol& s = symbols[i];
      const Colour ink = s.open ? status_colour(Status::open) : symbol_ink;
      if (!stage.plane) {
        stage.over.marker(kind.marker, stage.at(s), 0.45 * stage.em, ink);
        continue;
      }
      bool roller = false;
      const Local local = frame_of(stage, s, roller);
      const Point moved = s.open ? Point{} : 1 / local.size * (stage.at(s) - local.at), end{moved.x * local.along.x + moved.y * local.along.y, moved.x * local.out.x + moved.y * local.out.y};
      const double depth = kind.kind == SupportKind::spring ? spring_depth(stage) : rest;
      symbol(stage.over, kind.kind, local, std::max(1.1, stage.em / 18), roller, ink, end, depth);
      stage.tell(s.open ? "open support" : kind.name, Segment{local(end.x, end.y), local(0, depth)});
    }
  }
}

void sample(Canvas& c, const Box& b, double em, SupportKind kind, Colour ink) {
  const Local local{{b.centre().x, b.top - 0.05 * em}, {0, -1}, {1, 0}, std::min(support_size * em, 0.75 * b.height())};
  symbol(c, kind, local, std::max(1.1, em / 18), kind == SupportKind::slide, ink, {}, rest);
}

void support_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  for (const Kind& kind : kinds)
    if (stage.plane && kind.kind == SupportKind::spring && !symbols_of(stage, kind.kind).empty())
      out.push_back({kind.name, [em = stage.em, kind = kind.kind](Canvas& c, const Box& b) {
                       sample(c, b, em, kind, symbol_ink);
                     }});
    else if (!stage.plane && !symbols_of(stage, kind.kind).empty())
      out.push_back({kind.name, [em = stage.em, marker = kind.marker](Canvas& c, const Box& b) { c.marker(marker, b.centre(), 0.45 * em, symbol_ink); }});
  if (const auto open = std::ranges::find_if(stage.picture.supports, &SupportSymbol::open); stage.plane && open != stage.picture.supports.end())
    out.push_back({"support open", [em = stage.em, kind = open->kind](Canvas& c, const Box& b) { sample(c, b, em, kind, status_colour(Status::open)); }});
}

void support_bounds(const Stage& stage, Bounds& bounds) {
  if (!stage.plane) return;
  const double depth = spring_depth(stage) + 1.35 - rest;
  for (const SupportSymbol& s : stage.picture.supports)
    bounds.add(foot(stage, s) + (s.kind == SupportKind::spring ? depth : 1.35) * support_size * stage.em * stage.view.direction(s.normal));
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
  if (stage.plane)
    for (const auto& [first, next] : stretches_of(stage.picture.loads)) {
      // How far it reaches: along the outer ends, but where arrows run along the boundary.
      std::vector<Point> ends;
      for (std::size_t i = first; i < next; ++i) {
        const LoadArrow& load = stage.picture.loads[i];
        const bool across = std::abs(dot(load.vector, load.normal)) > 0.3 * length(load.vector);
        if (const Segment arrow = load_arrow(stage, load); across && stage.shows(arrow[0]) && stage.shows(arrow[1])) ends.push_back(arrow[length(arrow[0] - stage.at(load)) > 0.1 ? 0 : 1]);
      }
      stage.over.polyline(ends, width / 2, load_colour);
      if (ends.size() > 1) stage.tell("loaded", ends);
    }
  for (const std::size_t i : chosen(stage, stage.picture.loads, 0.95 * stage.em)) {
    const Segment arrow = load_arrow(stage, stage.picture.loads[i]);
    if (!stage.stays(stage.picture.loads[i])) continue;
    if (length(arrow[1] - arrow[0]) < 0.1 * stage.em) continue;
    // Along a boundary that is loaded along itself arrows would lie on each other.
    if (std::any_of(drawn.begin(), drawn.end(), [&](const Segment& other) { return distance(arrow, other) < 0.6 * stage.em; })) continue;
    drawn.push_back(arrow);
    if (stage.plane) {
      stage.over.arrow(arrow[0], arrow[1], width, tip, load_colour);
      stage.tell("load", arrow);
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
