#include "figure/page/support_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dotyk::figure {

namespace {

constexpr Colour idle_ink{175, 175, 175};
constexpr double pad_half = 0.42, pad_in = 0.13, pad_out = 0.42, neck = 0.75;  // em

class Element {
public:
  Element(Canvas& canvas, const SupportElement& element, const ElementPlace& place)
      : canvas_(canvas), element_(element), place_(place), em_(place.em), colour_(state_colour(element.state)) {}

  void draw() {
    const double end = place_.length, moved = place_.moved, rest = std::max(moved, 0.0);
    switch (element_.kind) {
      case ElementKind::none:
      case ElementKind::fixed: break;
      case ElementKind::spring:
        zigzag(moved, end);
        ground(end);
        break;
      case ElementKind::plate_spring:
        zigzag(rest, end);
        plate(rest);
        ground(end);
        break;
      case ElementKind::stop: stop(); break;
      case ElementKind::slider:
        pads(end);
        rod(moved, end);
        break;
      case ElementKind::plate_slider:
        pads(end);
        rod(rest, end);
        plate(rest);
        break;
      case ElementKind::capped_spring: {
        const double joint = end - 1.15 * em_ + std::min(place_.slip, 0.0);
        pads(end);
        rod(joint, end);
        zigzag(moved, joint);
        break;
      }
      case ElementKind::breaking_spring: breaking(rest, end); break;
      case ElementKind::paired_springs: paired(moved, end);
    }
  }

private:
  Point at(double s, double t) const { return place_.track(s, t); }
  double width() const { return std::max(1.6, em_ / 8); }

  void path(double from, double to, double t, double thick, Colour colour) {
    const int n = place_.track.straight() ? 1 : 16;
    std::vector<Point> points;
    for (int i = 0; i <= n; ++i) points.push_back(at(from + (to - from) * i / n, t));
    canvas_.polyline(points, thick, colour);
  }

  void ground(double s, double half = 0.55) { draw_ground(canvas_, place_.track, s, half * em_, em_); }
  void plate(double s) { canvas_.line(at(s, -0.5 * em_), at(s, 0.5 * em_), 1.6 * width(), colour_); }

  void zigzag(double from, double to) { zigzag(from, to, 0, 0.32 * em_, colour_); }

  // About t, with teeth of a.
  void zigzag(double from, double to, double t, double a, Colour colour) {
    const int teeth = std::clamp(static_cast<int>((to - from) / (0.36 * em_)), 2, 4);
    const double lead = 0.12 * (to - from);
    std::vector<Point> points{at(from, t), at(from + lead, t)};
    const double step = (to - from - 2 * lead) / (2 * teeth);
    for (int i = 0; i < 2 * teeth; ++i) points.push_back(at(from + lead + (i + 0.5) * step, i % 2 ? t + a : t - a));
    points.push_back(at(to - lead, t));
    points.push_back(at(to, t));
    canvas_.polyline(points, width(), colour);
  }

  void rod(double from, double end) { path(from, end + 0.35 * em_, 0, 1.3 * width(), colour_); }

  // They grip the rod; their outer sides are held.
  void pads(double end) {
    const double middle = end - 0.4 * em_;
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double s, double t) { return at(middle + s * pad_half * em_, side * t * em_); };
      const std::array pad{corner(-1, pad_in), corner(1, pad_in), corner(1, pad_out), corner(-1, pad_out)};
      canvas_.convex(pad, colour_, 0.55);
      canvas_.polyline(pad, 0.7 * width(), colour_, {}, true);
      canvas_.line(corner(-1.25, pad_out), corner(1.25, pad_out), 0.8 * width(), ground_ink);
      for (const double s : {-0.9, -0.15, 0.6, 1.25}) canvas_.line(corner(s, pad_out), corner(s - 0.5, pad_out + 0.24), 0.5 * width(), ground_ink);
    }
  }

  void stop() {
    const double end = place_.length, narrow = 0.24 * em_, wide = 0.42 * em_;
    constexpr int n = 12;
    std::vector<Point> post;
    for (int i = 0; i <= n; ++i) post.push_back(at(end * i / n, -narrow - (wide - narrow) * i / n));
    for (int i = n; i >= 0; --i) post.push_back(at(end * i / n, narrow + (wide - narrow) * i / n));
    canvas_.polygon(post, colour_, 0.55);
    canvas_.polyline(post, 0.7 * width(), colour_, {}, true);
    canvas_.line(at(0, -0.5 * em_), at(0, 0.5 * em_), 1.6 * width(), colour_);
    ground(end);
  }

  // On a common bar one that pushes and one that pulls; that which does not act is pale.
  void paired(double moved, double end) {
    const double apart = 0.36 * em_, teeth = 0.24 * em_;
    zigzag(moved, end, -apart, teeth, element_.state == SupportState::pulling ? idle_ink : colour_);
    zigzag(moved, end, apart, teeth, element_.state == SupportState::pushing ? idle_ink : colour_);
    canvas_.line(at(moved, -0.62 * em_), at(moved, 0.62 * em_), 1.6 * width(), colour_);
    ground(end, 0.75);
  }

  // A neck that tears joins the spring to the ground.
  void breaking(double rest, double end) {
    const bool broken = element_.state == SupportState::broken;
    const double top = broken ? rest + 0.3 * em_ : rest, foot = end - neck * em_;
    const double tear = broken ? 0.16 * em_ : 0, thin = broken ? 0.02 : 0.07;
    const double middle = (foot + end) / 2, side = broken ? 0.14 * em_ : 0;
    zigzag(top, foot - tear);
    plate(top);
    const auto half = [&](double base, double tip, double shift) {
      canvas_.convex(std::array{at(base, shift - 0.3 * em_), at(base, shift + 0.3 * em_), at(tip, shift + thin * em_), at(tip, shift - thin * em_)}, colour_);
    };
    half(foot - tear, middle - 1.2 * tear, side);
    half(end, middle + tear, -side);
    ground(end);
  }

  Canvas& canvas_;
  const SupportElement& element_;
  const ElementPlace& place_;
  double em_;
  Colour colour_;
};

}  // namespace

Point Track::operator()(double s, double t) const {
  if (straight()) return {origin_.x + t, origin_.y - s};
  const double angle = std::numbers::pi / 2 + sign_ * s / radius_;
  return origin_ + (radius_ + t) * Point{std::cos(angle), std::sin(angle)};
}

void draw_ground(Canvas& canvas, const Track& track, double s, double half, double em) {
  const double width = std::max(1.4, em / 10);
  canvas.line(track(s, -half), track(s, half), width, ground_ink);
  constexpr int strokes = 5;
  for (int i = 0; i < strokes; ++i) {
    const double t = half * (2.0 * (i + 0.7) / strokes - 1);
    canvas.line(track(s, t), track(s + 0.26 * em, t - 0.24 * em), 0.6 * width, ground_ink);
  }
}

void draw_element(Canvas& canvas, const SupportElement& element, const ElementPlace& place) { Element(canvas, element, place).draw(); }

}  // namespace dotyk::figure
