// Supports at the points of a beam.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "figure/page/page_cells.hpp"
#include "figure/page/support_element.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour beam_ink{30, 30, 30}, white{255, 255, 255};
constexpr double radius = 1.8, swing = 85 * std::numbers::pi / 180;  // of arcs: em, rad
constexpr double most_lean = 0.45;                                   // rad; steeper slopes are drawn as this
constexpr double stop_length = 1.1, pin_height = 1.05;               // em
constexpr double bar_half = 0.95;                                    // em, of an end that slides
constexpr double settlement_place = 1.3;                             // em beside the support

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

class SupportSymbols {
public:
  SupportSymbols(Canvas& canvas, const BeamDrawing& beam, const Axes& axes, const BeamSupport& support)
      : canvas_(canvas), beam_(beam), axes_(axes), support_(support), em_(symbol_em(axes)),
        at_(axes.at(support.x, support.deflection)) {
    lean_ = std::clamp(std::atan(support.rotation * axes.y.pixels_per_unit() / axes.x.pixels_per_unit()), -most_lean, most_lean);
  }

  void draw() {
    const bool held = support_.below.kind == ElementKind::fixed, turned = support_.arc.kind == ElementKind::fixed;
    if (held) draw_settlement();
    if (held && turned) return draw_clamp();
    if (held) draw_pin();
    if (moves(support_)) draw_below();
    if (turned)
      draw_guide();
    else if (support_.arc.kind != ElementKind::none)
      draw_arc();
  }

private:
  bool left() const { return at_left_end(beam_, support_); }
  bool right() const { return at_right_end(beam_, support_); }
  double width() const { return std::max(1.5, em_ / 9); }
  // Pixels along the beam and across it.
  Point local(double along, double across) const {
    const double c = std::cos(lean_), s = std::sin(lean_);
    return {at_.x + c * along - s * across, at_.y + s * along + c * across};
  }

  // From the axis to where the support has been put.
  void draw_settlement() {
    const double zero = axes_.y.pixel(0), x = at_.x + (left() ? -1 : 1) * settlement_place * em_;
    if (!shows_settlement(support_, axes_)) return;
    for (const double y : {zero, at_.y}) canvas_.line({x - 0.3 * em_, y}, {x + 0.3 * em_, y}, 0.5 * width(), ground_ink);
    canvas_.arrow({x, zero}, {x, at_.y}, 0.7 * width(), 0.5 * em_, ground_ink);
  }

  // A wall across the beam's end, hatched beyond; s: towards the outside.
  void wall(double side, double distance) {
    const double half = 1.15 * em_;
    const auto p = [&](double out, double up) { return local(side * out, up); };
    canvas_.line(p(distance, -half), p(distance, half), 1.6 * width(), ground_ink);
    for (int i = 0; i < 6; ++i) {
      const double up = half * (1 - i / 3.0);
      canvas_.line(p(distance, up), p(distance + 0.45 * em_, up - 0.36 * em_), 0.6 * width(), ground_ink);
    }
  }

  void draw_clamp() {
    if (left() || right()) return wall(left() ? -1 : 1, 0);
    for (const double side : {-1.0, 1.0}) {  // held between two blocks
      const auto p = [&](double along, double up) { return local(along * em_, side * up * em_); };
      canvas_.convex(std::array{p(-0.7, 0.1), p(0.7, 0.1), p(0.7, 0.45), p(-0.7, 0.45)}, ground_ink);
      for (const double s : {-0.55, -0.2, 0.15, 0.5}) canvas_.line(p(s, 0.45), p(s - 0.2, 0.72), 0.6 * width(), ground_ink);
    }
  }

  void draw_pin() {
    const Track down = Track::down(at_);
    const double foot = pin_height * em_;
    const std::array corners{at_, down(foot, -0.55 * em_), down(foot, 0.55 * em_)};
    canvas_.convex(corners, white);
    canvas_.polyline(corners, width(), state_colour(support_.below.state), {}, true);
    draw_ground(canvas_, down, foot, 0.75 * em_, em_);
    canvas_.disc(at_, 0.24 * em_, beam_ink);
    canvas_.disc(at_, 0.24 * em_ - width(), white);
  }

  void draw_below() {
    const double scale = axes_.y.pixels_per_unit();
    const double length = support_.below.kind == ElementKind::stop ? stop_length * em_ : ground_depth(beam_, scale, em_);
    draw_element(canvas_, support_.below,
                 {Track::down({at_.x, axes_.y.pixel(0)}), -scale * support_.deflection, -scale * support_.below.slip, length, em_});
  }

  // The rotation is held, the deflection is not: a wall with rollers; within the beam an arm without a joint.
  void draw_guide() {
    if (!left() && !right()) {
      const Track arc = Track::arc(at_, radius * em_, 1);
      for (const double t : {-0.12, 0.12}) {
        std::vector<Point> points;
        for (int i = 0; i <= 16; ++i) points.push_back(arc(swing * radius * em_ * i / 16, t * em_));
        canvas_.polyline(points, width(), state_colour(support_.arc.state));
      }
      draw_ground(canvas_, arc, swing * radius * em_, 0.55 * em_, em_);
      canvas_.line(at_, local(0, radius * em_), 1.6 * width(), beam_ink);
      return;
    }
    const double side = left() ? -1 : 1;
    canvas_.line(local(0, -bar_half * em_), local(0, bar_half * em_), 2 * width(), beam_ink);
    for (const double up : {-0.6, 0.6}) {
      canvas_.disc(local(side * 0.32 * em_, up * em_), 0.24 * em_, ground_ink);
      canvas_.disc(local(side * 0.32 * em_, up * em_), 0.24 * em_ - 0.8 * width(), white);
    }
    wall(side, 0.6 * em_);
  }

  // An arm upright on the beam, its end held along an arc.
  void draw_arc() {
    const double sign = arc_sign(beam_, support_), r = radius * em_;
    const double slope_scale = support_.rotation != 0 ? lean_ / support_.rotation : 0;
    const double slip = std::clamp(support_.arc.slip * slope_scale, -most_lean, most_lean);
    draw_element(canvas_, support_.arc, {Track::arc(at_, r, sign), sign * lean_ * r, sign * slip * r, swing * r, em_});
    canvas_.line(at_, local(0, r + 0.12 * em_), 1.8 * width(), beam_ink);
    canvas_.disc(at_, 0.16 * em_, beam_ink);
  }

  Canvas& canvas_;
  const BeamDrawing& beam_;
  const Axes& axes_;
  const BeamSupport& support_;
  double em_, lean_ = 0;
  Point at_;
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
    if (moves(s) && s.below.kind != ElementKind::stop) lowest = std::max(lowest, -s.deflection), rest = std::max(rest, rest_length(s.below.kind));
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
  if (s.below.kind == ElementKind::stop) depth = std::max(depth, (stop_length + 0.4) * em);
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
  for (const BeamSupport& support : beam.supports) SupportSymbols(canvas, beam, axes, support).draw();
}

}  // namespace dotyk::figure
