// Charts, drawn by hand on the canvas: vtkChartXY places curves on a
// logarithmic axis only at its second rendering, and knows neither markers
// that stand off each other nor slope guides.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "figure/canvas/axes.hpp"
#include "figure/canvas/canvas.hpp"
#include "figure/chart/chart_column.hpp"
#include "figure/chart/chart_layout.hpp"
#include "figure/chart/slope_guide.hpp"
#include "figure/door/figures.hpp"
#include "figure/canvas/legend.hpp"
#include "figure/canvas/text_fit.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour front_yellow{255, 232, 150};
constexpr std::array markers{Marker::disc, Marker::square, Marker::triangle, Marker::diamond,
                             Marker::down_triangle, Marker::ring, Marker::cross, Marker::plus};

constexpr double strip_gap = 0.45;  // in em

class Chart {
public:
  // Draws itself, from the canvas's origin.
  Chart(const ChartPicture& picture, Canvas& canvas, const ChartFrame& frame) : picture_(picture), canvas_(canvas), frame_(frame), em_(frame.em) {
    x_ = fit_axis(picture, false);
    y_ = fit_axis(picture, true);
    for (std::size_t k = 0; k < picture.series.size(); ++k)
      if (picture.series[k].y.empty() && !picture.series[k].x.empty()) failed_.push_back(static_cast<int>(k));
    place(0);
    Legend legend(entries(), 0.92 * em_);
    occupy();
    auto corner = free_place(occupied_, room_, legend.width(), legend.height(), 0.6 * em_);
    if (!corner && !legend.empty()) {
      // No free place among the curves: in rows above them.
      legend = Legend(entries(), 0.92 * em_, room_.width());
      place(legend.height());
      occupied_ = {};
      occupy();
      corner = Point{room_.left + (room_.width() - legend.width()) / 2, room_.top + strip_height() + 0.1 * em_};
    }
    draw_axes();
    draw_strip();
    canvas_.clip(room_);
    for (const SeriesPicture& s : picture.series) draw_front(s);
    for (std::size_t k = 0; k < picture.series.size(); ++k) draw_spread(static_cast<int>(k));
    for (std::size_t k = 0; k < picture.series.size(); ++k) draw_line(static_cast<int>(k));
    for (std::size_t k = 0; k < picture.series.size(); ++k) draw_whiskers(static_cast<int>(k));
    canvas_.no_clip();
    for (std::size_t k = 0; k < picture.series.size(); ++k) draw_markers(static_cast<int>(k));
    draw_frame(canvas_, axes());
    if (corner && !legend.empty()) {
      const bool inside = corner->y < room_.top - 1;
      legend.draw(canvas_, *corner, inside);
      if (inside) occupied_.add(Box{corner->x, corner->y, corner->x + legend.width(), corner->y + legend.height()});
    }
    for (const SlopeGuide& guide : picture.slopes) draw_guide(canvas_, picture, guide, axes(), occupied_);
  }

  ChartMargins margins() const { return {room_.left, picture_.width - room_.right, room_.bottom, picture_.height - room_.top}; }

private:
  double line_width() const { return std::max(1.5, em_ / 9); }
  double marker_size(const SeriesPicture& s) const { return (s.style == SeriesStyle::points ? 0.45 : 0.5) * em_; }
  static bool dense(const std::vector<Point>& curve, double spacing) {
    return curve.size() > 2 && std::abs(curve.back().x - curve.front().x) / static_cast<double>(curve.size() - 1) < spacing && curve.size() > 60;
  }

  // Margins from the widths of what stands in them.
  void place(double legend_height) {
    const double w = picture_.width, h = picture_.height;
    for (int round = 0; round < 2; ++round) {
      const double labels_x = std::max(3.0, room_.width() > 1 ? room_.width() / (4.5 * em_) : 6);
      const double labels_y = std::max(3.0, room_.height() > 1 ? room_.height() / (3.2 * em_) : 6);
      x_ticks_ = x_.log ? log_ticks(x_.low, x_.high, static_cast<int>(labels_x) + 1) : linear_ticks(x_.low, x_.high, std::min(8, static_cast<int>(labels_x)));
      y_ticks_ = y_.log ? log_ticks(y_.low, y_.high, static_cast<int>(labels_y) + 1) : few_ticks(y_.low, y_.high, std::min(8.0, labels_y));
      double widest = 0;
      for (const Tick& t : y_ticks_.ticks) widest = std::max(widest, text_extent(t.label, em_).x);
      if (!failed_.empty()) widest = std::max(widest, text_extent("converged", small_text * em_).x);
      double last = 0;
      for (const Tick& t : x_ticks_.ticks) last = std::max(last, text_extent(t.label, em_).x);
      room_.left = 0.6 * em_ + (picture_.y_label.empty() && !y_ticks_.exponent ? 0 : 1.7 * em_) + widest + 0.5 * em_;
      room_.left = std::max(room_.left, frame_.least.left);
      room_.bottom = frame_.x_labels ? 0.4 * em_ + (picture_.x_label.empty() && !x_ticks_.exponent ? 0 : 1.35 * em_) + 1.6 * em_ : 0.2 * em_;
      room_.right = w - std::max(0.6 * em_ + last / 2, frame_.least.right);
      room_.top = h - 0.9 * em_ - (picture_.title.empty() ? 0 : 1.9 * em_) - legend_height - strip_height();
      if (frame_.alone && equal()) make_square();
    }
    x_.from = room_.left, x_.to = room_.right;
    y_.from = room_.bottom, y_.to = room_.top;
  }

  bool equal() const { return !x_.log && !y_.log && picture_.x_range && picture_.x_range == picture_.y_range; }

  void make_square() {
    const double side = std::min(room_.width(), room_.height());
    indent_ = (room_.width() - side) / 2;
    room_ = {room_.left + indent_, room_.bottom, room_.right - indent_, room_.bottom + side};
  }

  void occupy() {
    for (const SeriesPicture& s : picture_.series) {
      for (const auto& curve : curves(s, x_, y_)) occupied_.add(curve, {room_.left, room_.bottom, room_.right, room_.top});
      for (std::size_t i = 0; i < s.x_low.size(); ++i)
        if (x_.shows(s.x_low[i]) && x_.shows(s.x_high[i]) && y_.shows(s.y[i]))
          occupied_.add({{x_.pixel(s.x_low[i]), y_.pixel(s.y[i])}, {x_.pixel(s.x_high[i]), y_.pixel(s.y[i])}}, room_);
      if (s.low.empty()) continue;
      for (const auto* bound : {&s.low, &s.high}) {
        SeriesPicture edge;
        edge.x = s.x, edge.y = *bound;
        for (const auto& curve : curves(edge, x_, y_)) occupied_.add(curve, room_);
      }
    }
  }

  std::vector<LegendEntry> entries() const {
    std::vector<LegendEntry> out;
    for (std::size_t k = 0; k < picture_.series.size(); ++k) {
      const SeriesPicture& s = picture_.series[k];
      if (s.name.empty()) continue;
      out.push_back({s.name, [this, k, &s](Canvas& canvas, const Box& b) {
                       const double middle = (b.bottom + b.top) / 2;
                       const std::array<Point, 2> line{{{b.left, middle}, {b.right, middle}}};
                       if (s.front) return canvas.polyline(line, front_width(), front_yellow);
                       if (!s.low.empty()) canvas.box({b.left, middle - 0.3 * em_, b.right, middle + 0.3 * em_}, colour(static_cast<int>(k)), 0.2);
                       if (s.style != SeriesStyle::points || s.reference) stroke(canvas, line, s, static_cast<int>(k));
                       if (s.style != SeriesStyle::line && !s.reference)
                         mark(canvas, s, static_cast<int>(k), {(b.left + b.right) / 2, middle});
                     }});
    }
    return out;
  }

  // Reference curves, statuses and twins take no colour of their own, so the k-th series keeps its own.
  int index(int k) const {
    const auto own = [](const SeriesPicture& s) { return !s.reference && !s.twin && !s.front && !s.status; };
    return std::max(0, static_cast<int>(std::count_if(picture_.series.begin(), picture_.series.begin() + k + 1, own)) - 1);
  }
  // Beside statuses only colours that are none of theirs.
  Colour colour(int k) const {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    if (s.reference) return reference_grey;
    if (s.status) return status_colour(*s.status);
    constexpr std::array clear{0, 2, 6};
    const bool statuses = std::any_of(picture_.series.begin(), picture_.series.end(), [](const SeriesPicture& other) { return other.status.has_value(); });
    return series_colour(statuses ? clear[static_cast<std::size_t>(index(k)) % clear.size()] : index(k));
  }
  Marker marker(int k) const {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    return s.status ? status_marker(*s.status) : markers[static_cast<std::size_t>(index(k)) % markers.size()];
  }

  void stroke(Canvas& canvas, std::span<const Point> points, const SeriesPicture& s, int k) const {
    const std::array<double, 2> dash{0.42 * em_, 0.26 * em_};
    canvas.polyline(points, line_width(), colour(k), s.reference || s.twin ? std::span<const double>(dash) : std::span<const double>());
  }

  void mark(Canvas& canvas, const SeriesPicture& s, int k, Point at) const {
    if (s.crossed) canvas.crossed_marker(marker(k), at, marker_size(s), colour(k));
    else canvas.marker(marker(k), at, marker_size(s), colour(k));
  }

  double front_width() const { return 0.9 * em_; }

  void draw_front(const SeriesPicture& s) {
    if (!s.front) return;
    for (const auto& curve : curves(s, x_, y_)) {
      canvas_.polyline(curve, front_width(), front_yellow);
      for (const Point& end : {curve.front(), curve.back()}) canvas_.disc(end, front_width() / 2, front_yellow);
    }
  }

  // From x_low to x_high at every point, with caps.
  void draw_whiskers(int k) {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    const double cap = 0.22 * em_, width = 0.8 * line_width();
    for (std::size_t i = 0; i < s.x_low.size(); ++i) {
      if (!x_.shows(s.x_low[i]) || !x_.shows(s.x_high[i]) || !y_.shows(s.y[i])) continue;
      const double y = y_.pixel(s.y[i]);
      const Point ends[] = {{x_.pixel(s.x_low[i]), y}, {x_.pixel(s.x_high[i]), y}};
      canvas_.line(ends[0], ends[1], width, colour(k));
      for (const Point& end : ends) canvas_.line({end.x, y - cap}, {end.x, y + cap}, width, colour(k));
    }
  }

  void draw_spread(int k) {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    if (s.low.empty()) return;
    const auto at = [&](std::size_t i, double v) { return Point{x_.pixel(s.x[i]), y_.pixel(y_.log ? std::max({v, y_.low * 1e-6, std::numeric_limits<double>::denorm_min()}) : v)}; };
    for (std::size_t i = 0; i + 1 < s.x.size(); ++i) {
      if (!x_.shows(s.x[i]) || !x_.shows(s.x[i + 1])) continue;
      canvas_.convex(std::array<Point, 4>{{at(i, s.low[i]), at(i + 1, s.low[i + 1]), at(i + 1, s.high[i + 1]), at(i, s.high[i])}}, colour(k), 0.2);
    }
  }

  void draw_line(int k) {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    if (s.front || (s.style == SeriesStyle::points && !s.reference)) return;
    for (const auto& curve : curves(s, x_, y_)) stroke(canvas_, curve, s, k);
  }

  void draw_markers(int k) {
    const SeriesPicture& s = picture_.series[static_cast<std::size_t>(k)];
    if (s.style == SeriesStyle::line || s.reference || s.front) return;
    for (const auto& curve : curves(s, x_, y_)) {
      // A line needs no marker at every one of many points; points alone do.
      const bool thin = s.style == SeriesStyle::both && dense(curve, marker_size(s));
      const double spacing = thin ? 0.08 * room_.width() : 0;
      Point last{-1e9, -1e9};
      for (const Point& p : curve) {
        if (!room_.holds(p, 0.5) || std::hypot(p.x - last.x, p.y - last.y) < spacing) continue;
        mark(canvas_, s, k, p);
        last = p;
      }
    }
  }

  double strip_height() const { return failed_.empty() ? 0 : strip_gap * em_ + std::max(2.3, 0.4 + 0.8 * static_cast<double>(failed_.size())) * em_; }

  // Above a break of the y axis: where there is no ordinate.
  void draw_strip() {
    if (failed_.empty()) return;
    const double foot = room_.top + strip_gap * em_;
    const Axes strip{{room_.left, foot, room_.right, room_.top + strip_height()}, x_, {}, x_ticks_, {}, em_};
    draw_grid(canvas_, strip);
    for (const double x : {room_.left, room_.right})
      for (const double y : {room_.top, foot}) canvas_.line({x - 0.3 * em_, y - 0.12 * em_}, {x + 0.3 * em_, y + 0.12 * em_}, std::max(1.2, em_ / 18), axes_ink);
    TextStyle style;
    style.size = small_text * em_;
    style.across = Align::high;
    const double middle = (strip.room.bottom + strip.room.top) / 2;
    style.up = Align::low;
    canvas_.text({room_.left - 0.4 * em_, middle}, "not", style);
    style.up = Align::high;
    canvas_.text({room_.left - 0.4 * em_, middle}, "converged", style);
    for (std::size_t row = 0; row < failed_.size(); ++row) {
      const SeriesPicture& s = picture_.series[static_cast<std::size_t>(failed_[row])];
      const double y = foot + strip.room.height() * (static_cast<double>(row) + 0.5) / static_cast<double>(failed_.size());
      for (const double x : s.x)
        if (const Point at{x_.shows(x) ? x_.pixel(x) : -1e9, y}; strip.room.holds(at, 0.5)) mark(canvas_, s, failed_[row], at);
    }
    draw_frame(canvas_, strip);
  }

  void draw_axes() {
    draw_grid(canvas_, axes());
    draw_ticks(canvas_, axes(), frame_.x_labels);
    draw_names();
    draw_title();
  }

  // Lines one below the other need no more room than one: their letters are half as high.
  void draw_names() {
    TextStyle style;
    style.across = Align::middle;
    const FittedText x = fitted(frame_.x_labels ? picture_.x_label : "", em_, picture_.width - em_, false, frame_.x_labels ? axis_name("", x_ticks_) : "");
    draw_lines(canvas_, {within(x), 0.4 * em_ + depth(x)}, x, style);
    const FittedText y = fitted(picture_.y_label, em_, room_.height(), false, axis_name("", y_ticks_));
    style.upright = true;
    style.up = Align::middle;
    style.across = Align::low;
    draw_lines(canvas_, {indent_ + 0.45 * em_, (room_.bottom + room_.top) / 2}, y, style);
  }

  void draw_title() {
    const FittedText title = fitted(picture_.title, 1.1 * em_, picture_.width - em_, true);
    draw_lines(canvas_, {within(title, true), picture_.height - 0.6 * em_}, title, title_style());
  }

  // The middle of the plot, unless the text is so long that the whole width is needed.
  double within(const FittedText& text, bool bold = false) const {
    double half = 0;
    for (const std::string& line : text.lines) half = std::max(half, text_extent(line, text.size, bold).x / 2);
    half += text.lines.size() > 1 ? 0.5 * em_ : 2;  // off the edge
    return std::clamp((room_.left + room_.right) / 2, half, std::max(half, picture_.width - half));
  }

  Axes axes() const { return {room_, x_, y_, x_ticks_, y_ticks_, em_}; }

  const ChartPicture& picture_;
  Canvas& canvas_;
  ChartFrame frame_;
  double em_;
  Axis x_, y_;
  Ticks x_ticks_, y_ticks_;
  Box room_;
  std::vector<int> failed_;  // series of the strip
  double indent_ = 0;  // of a plot narrower than it might be
  Occupied occupied_;
};

}  // namespace

ChartMargins draw_on(Canvas& canvas, const ChartPicture& picture, const ChartFrame& frame) { return Chart(picture, canvas, frame).margins(); }

void draw_chart(const ChartPicture& picture) {
  Canvas canvas(oversampling(picture.width, picture.height));
  draw_on(canvas, picture, {0.034 * std::min<double>(picture.height, 0.8 * picture.width), {}, true, true});
  write_canvas(canvas, picture.width, picture.height, picture.file);
}

}  // namespace dotyk::figure
