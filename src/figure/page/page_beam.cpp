// The cell of a beam: its deflection line, exaggerated as far as there is room for supports and loads.
#include <numbers>

#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

constexpr double load_gap = 0.2, most_load = 1.5, least_load = 0.45;  // em
constexpr double force_length = 2.2, moment_radius = 1.0, moment_depth = 1.3;

double height(double q, double most, double em) {
  return std::abs(q) > 1e-9 * most ? std::max(least_load, most_load * std::abs(q) / most) * em : 0;
}

// u at any x, between the points.
double deflection_at(const BeamDrawing& beam, double x) {
  const auto above = std::lower_bound(beam.x.begin(), beam.x.end(), x);
  const std::size_t j = std::min<std::size_t>(above - beam.x.begin(), beam.x.size() - 1), i = j > 0 ? j - 1 : 0;
  const double span = beam.x[j] - beam.x[i], t = span > 0 ? (x - beam.x[i]) / span : 0;
  return beam.deflection[i] + t * (beam.deflection[j] - beam.deflection[i]);
}

// Heights of loads above the deflection line, pixels, at each of the beam's points; `symbol`: the em of symbols.
std::vector<double> load_heights(const BeamDrawing& beam, double em, double symbol) {
  std::vector<double> out(beam.x.size(), 0);
  const double most = greatest(beam.load), label = 1.4 * em;
  for (std::size_t i = 0; i < beam.load.size(); ++i) {
    const double h = height(beam.load[i], most, em);
    if (h > 0) out[i] = load_gap * em + h + (std::abs(beam.load[i]) >= 0.999 * most ? label : 0.2 * em);
  }
  for (const BeamLoad& l : beam.loads)
    for (std::size_t i = 0; i < beam.x.size(); ++i)
      if (std::abs(beam.x[i] - l.x) < 1e-9 * beam.length)
        out[i] = std::max(out[i], l.force != 0 ? clear_of_bar(beam, l.x, symbol) + (force_length + 0.3) * em + label : moment_radius * em + 0.3 * em + label);
  return out;
}

// Loads on the deflection line: arrows above it, towards it or away from it.
class Loads {
public:
  Loads(Canvas& canvas, const BeamDrawing& beam, const Axes& axes) : canvas_(canvas), beam_(beam), axes_(axes), em_(axes.em), greatest_(greatest(beam.load)) {
    std::vector<Point> line;
    for (const double x : beam.x) line.push_back(on_line(x));
    occupied_.add(line, axes.room);
    occupied_.add({axes.at(0, 0), axes.at(beam.length, 0)}, axes.room);
    for (const auto& top : tops()) occupied_.add(top, axes.room);
    const double symbol = symbol_em(axes);
    for (const BeamSupport& s : beam.supports) {
      const Point p = on_line(s.x);
      const bool arc = s.arc.kind != ElementKind::none;
      const double beside = p.x + (s.x > 0 ? 1.3 : -1.3) * symbol;
      if (shows_settlement(s, axes)) occupied_.add({{beside, axes.y.pixel(0)}, {beside, p.y}}, axes.room);
      const double half = (arc ? 2.3 : 0.8) * symbol;
      if (arc || s.below.kind != ElementKind::none)
        occupied_.add(Box{p.x - half, axes.y.pixel(0) - ground_depth(beam, axes.y.pixels_per_unit(), symbol), p.x + half, p.y + (arc ? 2.4 : 0) * symbol});
    }
  }

  void draw_at_points() {
    double force = 0;
    for (const BeamLoad& l : beam_.loads) force = std::max(force, std::abs(l.force));
    for (const BeamLoad& l : beam_.loads) {
      if (l.force != 0) draw_force(l, force);
      if (l.moment != 0) draw_moment(l);
    }
    for (const BeamLoad& l : beam_.loads) label_point(l);
    if (!beam_.load.empty()) label_distributed();
  }

  void draw_distributed() {
    if (beam_.load.empty()) return;
    const double width = line_width();
    double last = -1e9;
    for (std::size_t i = 0; i < beam_.x.size(); ++i) {
      const auto [low, high] = arrow(i);
      const bool ends = i == 0 || i + 1 == beam_.x.size();
      const bool beside_end = !ends && axes_.x.pixel(beam_.x.back()) - low.x < 0.55 * em_;
      if (high.y == low.y || beside_end || beside_load(beam_.x[i]) || on_support(low) || below_arc(beam_, axes_, low.x) || !(ends || low.x - last > 1.1 * em_)) continue;
      canvas_.arrow(beam_.load[i] < 0 ? high : low, beam_.load[i] < 0 ? low : high, width, 0.38 * em_, load_colour);
      last = low.x;
    }
    for (const auto& top : tops()) canvas_.polyline(top, width, load_colour);
  }

private:
  double line_width() const { return std::max(1.0, em_ / 16); }

  // Of the load at a point: its end at the beam, and the other; the same where there is none.
  std::array<Point, 2> arrow(std::size_t i) const {
    const Point p{axes_.x.pixel(beam_.x[i]), axes_.y.pixel(beam_.deflection[i]) + load_gap * em_};
    return {p, Point{p.x, p.y + height(beam_.load[i], greatest_, em_)}};
  }

  // Lines along the arrows' ends.
  std::vector<std::vector<Point>> tops() const {
    return pieces(beam_.load.size(), [&](std::size_t i) {
      const auto [low, high] = arrow(i);
      return high.y > low.y ? std::optional(high) : std::nullopt;
    });
  }

  Point on_line(double x) const { return axes_.at(x, deflection_at(beam_, x)); }

  // Where the line runs beside a support that stands below the axis.
  bool on_support(Point low) const {
    return std::ranges::any_of(beam_.supports, [&](const BeamSupport& s) {
      const double axis = axes_.y.pixel(0);
      return s.below.kind != ElementKind::none && s.below.kind != ElementKind::fixed && low.y < axis + 0.7 * em_ && low.y > axis - 2.5 * symbol_em(axes_) &&
             std::abs(low.x - axes_.x.pixel(s.x)) < 0.8 * symbol_em(axes_) && std::abs(on_line(s.x).y - axis) < 0.5 * em_;
    });
  }

  // There the arrow of the point load stands.
  bool beside_load(double x) const {
    return std::any_of(beam_.loads.begin(), beam_.loads.end(), [&](const BeamLoad& l) {
      return std::abs(axes_.x.pixel(x) - axes_.x.pixel(l.x)) < (l.moment != 0 ? moment_radius + 0.3 : 0.5) * em_;
    });
  }

  void draw_force(const BeamLoad& l, double most) {
    const Point p = on_line(l.x);
    const double reach = (0.55 + 0.45 * std::abs(l.force) / most) * force_length * em_;
    const Point low{p.x, p.y + clear_of_bar(beam_, l.x, symbol_em(axes_)) + 0.15 * em_}, high{p.x, low.y + reach};
    canvas_.arrow(l.force < 0 ? high : low, l.force < 0 ? low : high, std::max(2.0, em_ / 7), 0.7 * em_, load_colour, 1.5);
    occupied_.add(Box{low.x - 0.3 * em_, low.y, low.x + 0.3 * em_, high.y});
  }

  // Over the point from one side to the other, in the sense of the moment.
  void draw_moment(const BeamLoad& l) {
    const Point p = on_line(l.x);
    const double r = moment_radius * em_, sign = l.moment > 0 ? 1 : -1, pi = std::numbers::pi;
    const double from = pi / 2 - sign * 0.75 * pi, to = pi / 2 + sign * 0.6 * pi, width = std::max(1.8, em_ / 9);
    std::vector<Point> points;
    for (int i = 0; i <= 32; ++i) {
      const double angle = from + (to - from) * i / 32;
      points.push_back(p + r * Point{std::cos(angle), std::sin(angle)});
    }
    canvas_.polyline(points, width, load_colour);
    const Point end = points.back(), tangent{-sign * std::sin(to), sign * std::cos(to)};
    canvas_.arrow(end - 0.1 * em_ * tangent, end + 0.55 * em_ * tangent, width, 0.6 * em_, load_colour);
    occupied_.add(Box{p.x - 1.2 * r, p.y - 0.8 * r, p.x + 1.2 * r, p.y + 1.1 * r});
  }

  void label_point(const BeamLoad& l) {
    const Point p = on_line(l.x);
    if (l.force != 0) label("F = " + number(l.force) + unit(beam_.force_unit), {p.x, p.y + clear_of_bar(beam_, l.x, symbol_em(axes_)) + (force_length + 0.6) * em_});
    if (l.moment != 0) label("M = " + number(l.moment) + unit(beam_.moment_unit), {p.x, p.y + (moment_radius + 0.5) * em_});
  }

  // The greatest, and each that stays the same for long.
  void label_distributed() {
    const std::size_t n = beam_.load.size();
    bool greatest_told = false;
    for (std::size_t i = 0, j = 0; i < n; i = j) {
      while (j < n && std::abs(beam_.load[j] - beam_.load[i]) <= 1e-3 * greatest_) ++j;
      const bool most = std::abs(beam_.load[i]) >= 0.998 * greatest_ && !greatest_told, lasts = beam_.x[j - 1] - beam_.x[i] > 0.15 * beam_.length;
      if (!(std::abs(beam_.load[i]) > 1e-9 * greatest_) || !(most || lasts)) continue;
      greatest_told = greatest_told || most;
      const std::size_t middle = (i + j - 1) / 2;
      const Point p = axes_.at(beam_.x[middle], beam_.deflection[middle]);
      label("q = " + number(beam_.load[middle]) + unit(beam_.load_unit), {p.x, p.y + load_gap * em_ + height(beam_.load[middle], greatest_, em_) + 0.4 * em_});
    }
  }

  static std::string unit(const std::string& name) { return name.empty() ? "" : " " + name; }

  // As near to the point as nothing else stands; not at all where there is no place.
  void label(const std::string& text, Point at) {
    const double size = 0.9 * em_;
    const Point extent = text_extent(text, size);
    const auto place = place_beside(occupied_, axes_.room, {at.x, at.y + extent.y / 2}, extent, 0.25 * em_);
    if (!place) return;
    occupied_.add(Box::about(*place, extent));
    canvas_.text(*place, text, {.size = size, .across = Align::middle, .up = Align::middle, .colour = load_colour, .halo = true});
  }

  Canvas& canvas_;
  const BeamDrawing& beam_;
  const Axes& axes_;
  double em_, greatest_;
  Occupied occupied_;
};

struct Room {
  double above, below;  // pixels from the axis
};

// What a beam drawn at so many pixels per unit of deflection needs.
Room needs(const BeamDrawing& beam, const std::vector<double>& heights, double scale, double em, double symbol) {
  Room room{0.8 * em, 0.8 * em};
  for (std::size_t i = 0; i < beam.x.size(); ++i) {
    room.above = std::max(room.above, scale * beam.deflection[i] + std::max(heights[i], 0.6 * em));
    room.below = std::max(room.below, -scale * beam.deflection[i] + 0.6 * em);
  }
  for (const BeamLoad& load : beam.loads)
    if (load.moment != 0) room.below = std::max(room.below, moment_depth * em - scale * deflection_at(beam, load.x));
  for (const BeamSupport& s : beam.supports) {
    room.above = std::max(room.above, scale * s.deflection + height_above(s, symbol));
    room.below = std::max(room.below, depth_below(beam, s, scale, symbol));
  }
  return room;
}

}  // namespace

void fit_y(const BeamDrawing& beam, Axes& axes) {
  const std::vector<double> heights = load_heights(beam, axes.em, symbol_em(axes));
  const double height = axes.room.height(), most = greatest(beam.deflection);
  const bool rests = !std::isfinite(height / most);  // also a deflection that no scale makes seen
  // Needs grow with the scale: the greatest that fits, by bisection.
  double low = 0, high = rests ? 0 : height / most;
  for (int i = 0; i < 60 && !rests; ++i) {
    const double middle = (low + high) / 2;
    const Room room = needs(beam, heights, middle, axes.em, symbol_em(axes));
    (room.above + room.below <= height ? low : high) = middle;
  }
  double scale = low;
  if (!(scale > 0)) scale = rests ? height : 0.1 * height / most;  // no room at all: drawn over the rim
  const Room room = needs(beam, heights, rests ? 0 : scale, axes.em, symbol_em(axes));
  const double zero = axes.room.bottom + room.below + 0.5 * (height - room.above - room.below);
  axes.y.from = axes.room.bottom, axes.y.to = axes.room.top;
  axes.y.low = (axes.room.bottom - zero) / scale, axes.y.high = (axes.room.top - zero) / scale;
  axes.y_ticks = rests ? Ticks{{{0, "0"}}, 0} : few_ticks(axes.y.low, axes.y.high, height / (2.6 * axes.em), plain_numbers);
}

void draw_cell(Canvas& canvas, const BeamDrawing& beam, const Axes& axes) {
  const double em = axes.em;
  canvas.clip(axes.room);
  const std::array<double, 2> dash{0.5 * em, 0.3 * em};
  canvas.polyline(std::array{axes.at(0, 0), axes.at(beam.length, 0)}, std::max(1.2, em / 16), {120, 120, 120}, dash);
  Loads loads(canvas, beam, axes);
  loads.draw_distributed();
  const std::vector<Point> line = axes.line(beam.x, beam.deflection);
  canvas.tell({"beam", axes.values(line)});
  canvas.polyline(line, std::max(3.0, em / 4.5), {30, 30, 30});
  draw_supports(canvas, beam, axes);
  loads.draw_at_points();
  canvas.no_clip();
}

}  // namespace dotyk::figure
