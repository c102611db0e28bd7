// Supports at the points of a beam: the elements that they consist of, below the beam or along an arc about its rotation.
#include <numbers>

#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour beam_ink{30, 30, 30}, white{255, 255, 255}, ground_ink{70, 70, 70};
constexpr double radius = 1.8, swing = 85 * std::numbers::pi / 180;  // of arcs: em, rad
constexpr double most_lean = 0.45;                                   // rad; steeper slopes are drawn as this
constexpr double stop_length = 1.1, pin_height = 1.05;               // em
constexpr double bar_half = 0.95;                                    // em, of an end that slides
constexpr double settlement_place = 1.3;                             // em beside the support
constexpr double pad_half = 0.42, pad_in = 0.13, pad_out = 0.42, neck = 0.75;  // em
constexpr double reach = 0.85;  // of elements and ground across and beyond, in em: what room they need

// Where an element runs: s pixels from where its moving end is at rest, towards
// the ground; t pixels across. Down from its origin, or along an arc that begins above
// the origin and turns to the left (sign 1) or right (-1).
struct Track {
  Point origin;
  double radius = 0, sign = 1, start = 0;  // start: of an arc, where s begins on it
  Point operator()(double s, double t) const {
    if (radius == 0) return {origin.x + t, origin.y - s};
    const double angle = std::numbers::pi / 2 + sign * (start + s) / radius;
    return origin + (radius + t) * Point{std::cos(angle), std::sin(angle)};
  }
  std::vector<Point> along(double from, double to, double t) const {
    const int n = radius == 0 ? 1 : 16;
    std::vector<Point> points;
    for (int i = 0; i <= n; ++i) points.push_back((*this)(from + (to - from) * i / n, t));
    return points;
  }
};

// A line of ground across, hatched beyond.
void draw_ground(Canvas& canvas, const Track& track, double s, double half, double em) {
  const double width = std::max(1.4, em / 10);
  canvas.line(track(s, -half), track(s, half), width, ground_ink);
  constexpr int strokes = 5;
  for (int i = 0; i < strokes; ++i) {
    const double t = half * (2.0 * (i + 0.7) / strokes - 1);
    canvas.line(track(s, t), track(s + 0.26 * em, t - 0.24 * em), 0.6 * width, ground_ink);
  }
}

struct Element {
  Canvas& canvas;
  const SupportElement& element;
  Track track;
  double moved;   // s of what the element holds
  double slip;    // s by which a capped spring's rod has slipped
  double length;  // s of the ground
  double em;
  Colour own = state_colour(element.state);

  void draw() {
    const bool lifts = element.kind == ElementKind::plate_spring || element.kind == ElementKind::plate_slider || element.kind == ElementKind::breaking_spring;
    const double end = length, top = lifts ? std::max(moved, 0.0) : moved;
    switch (element.kind) {
      case ElementKind::none:
      case ElementKind::fixed: break;
      case ElementKind::spring:
      case ElementKind::plate_spring:
        zigzag(top, end);
        ground(end);
        break;
      case ElementKind::stop: stop(); break;
      case ElementKind::slider:
      case ElementKind::plate_slider:
        pads(end);
        rod(top, end);
        break;
      case ElementKind::capped_spring: {
        const double joint = end - 1.15 * em + std::min(slip, 0.0);
        pads(end);
        rod(joint, end);
        zigzag(top, joint);
        break;
      }
      case ElementKind::breaking_spring: return breaking(top, end);
      case ElementKind::paired_springs: paired(top, end);
    }
    if (lifts) plate(top);
  }

  Point at(double s, double t) const { return track(s, t); }
  double width() const { return std::max(1.6, em / (element.state == SupportState::open ? 14 : 8)); }

  void ground(double s, double half = 0.55) { draw_ground(canvas, track, s, half * em, em); }
  void plate(double s) { canvas.line(at(s, -0.5 * em), at(s, 0.5 * em), 1.6 * width(), own); }

  void zigzag(double from, double to) { zigzag(from, to, 0, 0.32 * em, own); }

  // About t, with teeth of a.
  void zigzag(double from, double to, double t, double a, Colour colour) {
    const int teeth = std::clamp(static_cast<int>((to - from) / (0.36 * em)), 2, 4);
    const double lead = 0.12 * (to - from);
    std::vector<Point> points{at(from, t), at(from + lead, t)};
    const double step = (to - from - 2 * lead) / (2 * teeth);
    for (int i = 0; i < 2 * teeth; ++i) points.push_back(at(from + lead + (i + 0.5) * step, i % 2 ? t + a : t - a));
    points.push_back(at(to - lead, t));
    points.push_back(at(to, t));
    canvas.polyline(points, width(), colour);
  }

  void rod(double from, double end) { canvas.polyline(track.along(from, end + 0.35 * em, 0), 1.3 * width(), own); }

  // They grip the rod; their outer sides are held.
  void pads(double end) {
    const double middle = end - 0.4 * em;
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double s, double t) { return at(middle + s * pad_half * em, side * t * em); };
      const std::array pad{corner(-1, pad_in), corner(1, pad_in), corner(1, pad_out), corner(-1, pad_out)};
      canvas.convex(pad, own, 0.55);
      canvas.polyline(pad, 0.7 * width(), own, {}, true);
      canvas.line(corner(-1.25, pad_out), corner(1.25, pad_out), 0.8 * width(), ground_ink);
      for (const double s : {-0.9, -0.15, 0.6, 1.25}) canvas.line(corner(s, pad_out), corner(s - 0.5, pad_out + 0.24), 0.5 * width(), ground_ink);
    }
  }

  void stop() {
    const double end = length, narrow = 0.24 * em, wide = 0.42 * em;
    constexpr int n = 12;
    const auto side = [&](int i, double sign) { return at(end * i / n, sign * (narrow + (wide - narrow) * i / n)); };
    std::vector<Point> post;
    for (int i = 0; i <= n; ++i) post.push_back(side(i, -1));
    for (int i = n; i >= 0; --i) post.push_back(side(i, 1));
    for (int i = 0; i < n; ++i) canvas.convex(std::array{side(i, -1), side(i + 1, -1), side(i + 1, 1), side(i, 1)}, own, element.state == SupportState::open ? 0.15 : 0.55);
    canvas.polyline(post, 0.7 * width(), own, {}, true);
    canvas.line(at(0, -0.5 * em), at(0, 0.5 * em), 1.6 * width(), own);
    ground(end);
  }

  // On a common bar one that pushes and one that pulls; that which does not act is pale.
  void paired(double top, double end) {
    const double apart = 0.36 * em, teeth = 0.24 * em;
    zigzag(top, end, -apart, teeth, element.state == SupportState::pulling ? idle_ink : own);
    zigzag(top, end, apart, teeth, element.state == SupportState::pushing ? idle_ink : own);
    canvas.line(at(top, -0.62 * em), at(top, 0.62 * em), 1.6 * width(), own);
    ground(end, 0.75);
  }

  // A neck that tears joins the spring to the ground.
  void breaking(double rest, double end) {
    const bool broken = element.state == SupportState::broken;
    const double top = broken ? rest + 0.3 * em : rest, foot = end - neck * em;
    const double tear = broken ? 0.16 * em : 0, thin = broken ? 0.02 : 0.07;
    const double middle = (foot + end) / 2, side = broken ? 0.14 * em : 0;
    zigzag(top, foot - tear);
    plate(top);
    const auto half = [&](double base, double tip, double shift) {
      canvas.convex(std::array{at(base, shift - 0.3 * em), at(base, shift + 0.3 * em), at(tip, shift + thin * em), at(tip, shift - thin * em)}, own);
    };
    half(foot - tear, middle - 1.2 * tear, side);
    half(end, middle + tear, -side);
    ground(end);
  }
};

// From an element's moving end at rest to the ground, em.
double rest_length(ElementKind kind) {
  if (kind == ElementKind::stop) return stop_length;
  return kind == ElementKind::capped_spring || kind == ElementKind::breaking_spring ? 2.9 : 2.1;
}

bool moves(const BeamSupport& s) { return s.below.kind != ElementKind::none && s.below.kind != ElementKind::fixed; }

bool at_left_end(const BeamDrawing& beam, const BeamSupport& s) { return s.x <= 1e-9 * beam.length; }
bool at_right_end(const BeamDrawing& beam, const BeamSupport& s) { return s.x >= (1 - 1e-9) * beam.length; }

// To the left (1), where slopes above zero turn the arm; at the right end outside, if it resists both senses alike.
double arc_sign(const BeamDrawing& beam, const BeamSupport& s) { return at_right_end(beam, s) && !s.directed_arc ? -1 : 1; }

struct SupportSymbols {
  Canvas& canvas;
  const BeamDrawing& beam;
  const Axes& axes;
  const BeamSupport& support;
  double em = symbol_em(axes);
  Point place = axes.at(support.x, support.deflection);
  double lean = leaning(support.rotation);

  void draw() {
    const bool held = support.below.kind == ElementKind::fixed, turned = support.arc.kind == ElementKind::fixed;
    if (held) draw_settlement();
    if (held && turned) return draw_clamp();
    if (held) draw_pin();
    if (moves(support)) draw_below();
    if (turned)
      draw_guide();
    else if (support.arc.kind != ElementKind::none)
      draw_arc();
  }

  double leaning(double slope) const { return std::clamp(std::atan(slope * axes.y.pixels_per_unit() / axes.x.pixels_per_unit()), -most_lean, most_lean); }
  bool left() const { return at_left_end(beam, support); }
  bool right() const { return at_right_end(beam, support); }
  double width() const { return std::max(1.5, em / 9); }
  // Pixels along the beam and across it.
  Point local(double along, double across) const {
    const double c = std::cos(lean), s = std::sin(lean);
    return {place.x + c * along - s * across, place.y + s * along + c * across};
  }

  // From the axis to where the support has been put.
  void draw_settlement() {
    const double zero = axes.y.pixel(0), x = place.x + (left() ? -1 : 1) * settlement_place * em;
    if (!shows_settlement(support, axes)) return;
    for (const double y : {zero, place.y}) canvas.line({x - 0.3 * em, y}, {x + 0.3 * em, y}, 0.5 * width(), ground_ink);
    canvas.arrow({x, zero}, {x, place.y}, 0.7 * width(), 0.5 * em, ground_ink);
  }

  // A wall across the beam's end, hatched beyond; s: towards the outside.
  void wall(double side, double distance) {
    const double half = 1.15 * em;
    const auto p = [&](double out, double up) { return local(side * out, up); };
    canvas.line(p(distance, -half), p(distance, half), 1.6 * width(), ground_ink);
    for (int i = 0; i < 6; ++i) {
      const double up = half * (1 - i / 3.0);
      canvas.line(p(distance, up), p(distance + 0.45 * em, up - 0.36 * em), 0.6 * width(), ground_ink);
    }
  }

  void draw_clamp() {
    if (left() || right()) return wall(left() ? -1 : 1, 0);
    for (const double side : {-1.0, 1.0}) {  // held between two blocks
      const auto p = [&](double along, double up) { return local(along * em, side * up * em); };
      canvas.convex(std::array{p(-0.7, 0.1), p(0.7, 0.1), p(0.7, 0.45), p(-0.7, 0.45)}, ground_ink);
      for (const double s : {-0.55, -0.2, 0.15, 0.5}) canvas.line(p(s, 0.45), p(s - 0.2, 0.72), 0.6 * width(), ground_ink);
    }
  }

  void draw_pin() {
    const Track down = Track{place};
    const double foot = pin_height * em;
    const std::array corners{place, down(foot, -0.55 * em), down(foot, 0.55 * em)};
    canvas.convex(corners, white);
    canvas.polyline(corners, width(), state_colour(support.below.state), {}, true);
    draw_ground(canvas, down, foot, 0.75 * em, em);
    canvas.disc(place, 0.24 * em, beam_ink);
    canvas.disc(place, 0.24 * em - width(), white);
  }

  void draw_below() {
    const double scale = axes.y.pixels_per_unit();
    const double length = support.below.kind == ElementKind::stop ? stop_length * em : ground_depth(beam, scale, em) + scale * support.rest;
    const Track down{{place.x, axes.y.pixel(support.rest)}};
    const double moved = scale * (support.rest - support.deflection);
    Element{canvas, support.below, down, moved, -scale * support.below.slip, length, em}.draw();
    const std::string name = state_name(support.below.state);
    canvas.tell({name, {axes.values(down(0, 0)), axes.values(down(moved, 0)), axes.values(down(length, 0))}});
  }

  // The rotation is held, the deflection is not: a wall with rollers; within the beam an arm without a joint.
  void draw_guide() {
    if (!left() && !right()) {
      const Track arc = Track{place, radius * em, 1};
      for (const double t : {-0.12, 0.12}) canvas.polyline(arc.along(0, swing * radius * em, t * em), width(), state_colour(support.arc.state));
      draw_ground(canvas, arc, swing * radius * em, 0.55 * em, em);
      canvas.line(place, local(0, radius * em), 1.6 * width(), beam_ink);
      return;
    }
    const double side = left() ? -1 : 1;
    canvas.line(local(0, -bar_half * em), local(0, bar_half * em), 2 * width(), beam_ink);
    for (const double up : {-0.6, 0.6}) {
      canvas.disc(local(side * 0.32 * em, up * em), 0.24 * em, ground_ink);
      canvas.disc(local(side * 0.32 * em, up * em), 0.24 * em - 0.8 * width(), white);
    }
    wall(side, 0.6 * em);
  }

  // An arm upright on the beam, its end held along an arc.
  void draw_arc() {
    const double sign = arc_sign(beam, support), r = radius * em;
    const double slope_scale = support.rotation != 0 ? lean / support.rotation : 0, start = sign * r * leaning(support.rest_rotation);
    const double slip = std::clamp(support.arc.slip * slope_scale, -most_lean, most_lean);
    Element{canvas, support.arc, Track{place, r, sign, start}, sign * lean * r - start, sign * slip * r, swing * r - start, em}.draw();
    canvas.line(place, local(0, r + 0.12 * em), 1.8 * width(), beam_ink);
    canvas.disc(place, 0.16 * em, beam_ink);
  }
};

}  // namespace

double symbol_em(const Axes& axes) { return std::min({1.4 * axes.em, axes.room.height() / 9, axes.room.width() / 22}); }

double beyond_ends(const BeamDrawing& beam) {
  double most = 0.9;
  for (const BeamSupport& s : beam.supports) {
    if (!at_left_end(beam, s) && !at_right_end(beam, s)) continue;
    const bool held = s.below.kind == ElementKind::fixed, turned = s.arc.kind == ElementKind::fixed;
    if (held) most = std::max(most, s.deflection != 0 ? settlement_place + 0.5 : 1.0);
    if (turned) most = std::max(most, 1.3);
    if (!turned && s.arc.kind != ElementKind::none) most = std::max(most, radius + reach);
  }
  return most;
}

bool shows_settlement(const BeamSupport& s, const Axes& axes) {
  return s.below.kind == ElementKind::fixed && std::abs(axes.y.pixel(0) - axes.y.pixel(s.deflection)) > 0.6 * symbol_em(axes);
}

double ground_depth(const BeamDrawing& beam, double scale, double em) {
  double lowest = 0, rest = 0;
  for (const BeamSupport& s : beam.supports)
    if (moves(s) && s.below.kind != ElementKind::stop) lowest = std::max({lowest, -s.deflection, -s.rest}), rest = std::max(rest, rest_length(s.below.kind));
  return rest * em + scale * lowest;
}

double clear_of_bar(const BeamDrawing& beam, double x, double em) {
  for (const BeamSupport& s : beam.supports) {
    const bool end = at_left_end(beam, s) || at_right_end(beam, s), guided = s.arc.kind == ElementKind::fixed && s.below.kind != ElementKind::fixed;
    if (end && guided && std::abs(s.x - x) <= 1e-9 * beam.length) return (bar_half + 0.15) * em;
  }
  return 0;
}

double height_above(const BeamSupport& s, double em) {
  if (s.arc.kind == ElementKind::none) return 0.4 * em;
  const bool wall = s.arc.kind == ElementKind::fixed;
  return wall ? 1.4 * em : (radius + reach) * em;
}

double depth_below(const BeamDrawing& beam, const BeamSupport& s, double scale, double em) {
  const double at = -scale * s.deflection;
  double depth = at + (s.arc.kind == ElementKind::fixed ? 1.5 : 0.4) * em;
  if (s.below.kind == ElementKind::fixed) depth = std::max(depth, at + (pin_height + 0.4) * em);
  if (s.below.kind == ElementKind::stop) depth = std::max(depth, (stop_length + 0.4) * em - scale * s.rest);
  else if (moves(s)) depth = std::max(depth, ground_depth(beam, scale, em) + 0.5 * em);
  return depth;
}

bool below_arc(const BeamDrawing& beam, const Axes& axes, double pixel) {
  const double em = symbol_em(axes);
  return std::any_of(beam.supports.begin(), beam.supports.end(), [&](const BeamSupport& s) {
    const bool wall = s.arc.kind == ElementKind::fixed && (s.below.kind == ElementKind::fixed || at_left_end(beam, s) || at_right_end(beam, s));
    if (s.arc.kind == ElementKind::none || wall) return false;
    const double ahead = arc_sign(beam, s) * (axes.x.pixel(s.x) - pixel);  // on the side of the arc
    return ahead > -0.9 * em && ahead < (radius + reach) * em;
  });
}

void draw_supports(Canvas& canvas, const BeamDrawing& beam, const Axes& axes) {
  for (const BeamSupport& support : beam.supports) SupportSymbols{canvas, beam, axes, support}.draw();
}

}  // namespace dotyk::figure
