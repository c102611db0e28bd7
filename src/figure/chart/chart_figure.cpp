// Charts, drawn by hand on the canvas: vtkChartXY places curves on a
// logarithmic axis only at its second rendering, and knows neither markers
// that stand off each other nor slope guides.
#include <limits>
#include <optional>

#include "figure/canvas/legend.hpp"
#include "figure/canvas/paper.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/chart/chart.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour front_yellow{255, 232, 150};
constexpr std::array markers{Marker::disc, Marker::square, Marker::triangle, Marker::diamond,
                             Marker::down_triangle, Marker::ring, Marker::cross, Marker::plus};

constexpr double strip_gap = 0.45;  // in em

// How a series is drawn.
struct Look {
  const SeriesPicture& data;
  Colour colour;
  Marker marker;
  bool dashed;
};

// Methods have the same colour and marker in every chart: their places in this order, dashed beyond as many as there are colours.
constexpr std::array methods{"pdas", "newton", "projected_cg", "interior_point", "uzawa", "active_set", "psor", "feti", "multigrid", "uzawa_pdas", "coulomb_loop", "penalty", "proximal"};

bool takes_colour(const SeriesPicture& s) { return !s.reference && !s.twin && !s.front && !s.status; }

// For each series that takes a colour, the place of its name among the methods. Empty if one has another name, or two have the same.
std::vector<int> places_of_methods(const std::vector<SeriesPicture>& series) {
  std::vector<int> places;
  for (const SeriesPicture& s : series) {
    if (!takes_colour(s)) continue;
    const int place = static_cast<int>(std::find(methods.begin(), methods.end(), s.name) - methods.begin());
    if (place == static_cast<int>(methods.size()) || std::find(places.begin(), places.end(), place) != places.end()) return {};
    places.push_back(place);
  }
  return places;
}

// Reference curves, statuses and twins take no colour of their own, so the k-th series keeps its own. Beside statuses only
// colours that are none of theirs.
std::vector<Look> looks(const std::vector<SeriesPicture>& series) {
  constexpr int kColours = 7;
  constexpr std::array clear{0, 2, 6};
  const bool statuses = std::any_of(series.begin(), series.end(), [](const SeriesPicture& s) { return s.status.has_value(); });
  const std::vector<int> places = statuses ? std::vector<int>{} : places_of_methods(series);
  std::vector<Look> out;
  int own = 0;
  for (const SeriesPicture& s : series) {
    if (takes_colour(s)) ++own;
    int k = std::max(0, own - 1);
    if (!places.empty()) k = places[k];
    const Colour colour = s.reference ? reference_grey : s.status ? status_colour(*s.status) : series_colour(statuses ? clear[k % clear.size()] : k);
    out.push_back({s, colour, s.status ? status_marker(*s.status) : markers[k % markers.size()], s.reference || s.twin || (!statuses && k >= kColours)});
  }
  return out;
}

// Those of a legend.
std::vector<Look> named(const ChartPicture& picture) {
  std::vector<Look> out;
  for (const Look& look : looks(picture.series))
    if (!look.data.name.empty()) out.push_back(look);
  return out;
}

// Draws series; lines and markers are sized by the height of letters.
struct Pen {
  double em;

  double line_width() const { return std::max(1.5, em / 9); }
  double front_width() const { return 0.9 * em; }
  double marker_size(const SeriesPicture& s) const { return (s.style == SeriesStyle::points ? 0.45 : 0.5) * em; }

  void sample(Canvas& canvas, const Look& look, const Box& b) const {
    const SeriesPicture& s = look.data;
    if (s.front) return canvas.polyline(b.midline(), front_width(), front_yellow);
    const double middle = b.centre().y;
    if (!s.low.empty()) canvas.box({b.left, middle - 0.3 * em, b.right, middle + 0.3 * em}, look.colour, 0.2);
    if (s.style != SeriesStyle::points || s.reference) stroke(canvas, b.midline(), look);
    if (s.style != SeriesStyle::line && !s.reference) mark(canvas, look, b.centre());
  }

  void stroke(Canvas& canvas, std::span<const Point> points, const Look& look) const {
    const std::array<double, 2> dash{0.42 * em, 0.26 * em};
    canvas.polyline(points, line_width(), look.colour, look.dashed ? std::span<const double>(dash) : std::span<const double>());
  }

  void mark(Canvas& canvas, const Look& look, Point at) const {
    if (look.data.crossed) canvas.crossed_marker(look.marker, at, marker_size(look.data), look.colour);
    else canvas.marker(look.marker, at, marker_size(look.data), look.colour);
  }
};

class Chart {
public:
  // Draws itself, from the canvas's origin.
  Chart(const ChartPicture& picture, Canvas& canvas, const ChartFrame& frame)
      : picture_(picture), canvas_(canvas), frame_(frame), em_(frame.em), pen_{frame.em}, looks_(looks(picture.series)) {
    axes_.em = em_, axes_.x = fit_axis(picture, false), axes_.y = fit_axis(picture, true);
    for (const Look& look : looks_)
      if (look.data.y.empty() && !look.data.x.empty()) failed_.push_back(look);
    place(0);
    Legend legend = frame.legend ? chart_legend(picture, em_, 0) : Legend({}, em_);
    occupy();
    auto corner = free_place(occupied_, room_, {legend.width(), legend.height()}, 0.6 * em_);
    if (!corner && !legend.empty()) {
      // No free place among the curves: in rows above them.
      legend = chart_legend(picture, em_, room_.width());
      place(legend.height());
      occupied_ = {};
      occupy();
      corner = Point{room_.left + (room_.width() - legend.width()) / 2, room_.top + strip_height() + 0.1 * em_};
    }
    draw_axes();
    draw_strip();
    canvas_.clip(room_);
    for (const Look& look : looks_) draw_front(look);
    for (const Look& look : looks_) draw_spread(look);
    for (const Look& look : looks_) draw_line(look);
    for (const Look& look : looks_) draw_whiskers(look);
    canvas_.no_clip();
    for (const Look& look : looks_) draw_markers(look);
    draw_frame(canvas_, axes_);
    if (corner && !legend.empty()) {
      const bool inside = corner->y < room_.top - 1;
      legend.draw(canvas_, *corner, inside);
      if (inside) occupied_.add(Box{corner->x, corner->y, corner->x + legend.width(), corner->y + legend.height()});
    }
    for (const SlopeGuide& guide : picture.slopes) draw_guide(canvas_, picture, guide, axes_, occupied_);
  }

  ChartMargins margins() const { return {room_.left, picture_.width - room_.right, room_.bottom, picture_.height - room_.top}; }

private:
  static bool dense(const std::vector<Point>& curve, double spacing) {
    return curve.size() > 2 && std::abs(curve.back().x - curve.front().x) / static_cast<double>(curve.size() - 1) < spacing && curve.size() > 60;
  }

  // Margins from the widths of what stands in them.
  void place(double legend_height) {
    Axis &x = axes_.x, &y = axes_.y;
    for (int round = 0; round < 2; ++round) {
      const double labels_x = std::max(3.0, room_.width() > 1 ? room_.width() / (4.5 * em_) : 6);
      const double labels_y = std::max(3.0, room_.height() > 1 ? room_.height() / (3.2 * em_) : 6);
      axes_.x_ticks = x.log ? log_ticks(x.low, x.high, static_cast<int>(labels_x) + 1) : linear_ticks(x.low, x.high, std::min(8, static_cast<int>(labels_x)));
      axes_.y_ticks = y.log ? log_ticks(y.low, y.high, static_cast<int>(labels_y) + 1) : few_ticks(y.low, y.high, std::min(8.0, labels_y));
      const double widest = std::max(widest_label(axes_.y_ticks, em_), failed_.empty() ? 0 : text_extent("converged", small_text * em_).x);
      room_.left = 0.6 * em_ + (picture_.y_label.empty() && !axes_.y_ticks.exponent ? 0 : 1.7 * em_) + widest + 0.5 * em_;
      room_.left = std::max(room_.left, frame_.least.left);
      room_.bottom = frame_.x_labels ? 0.4 * em_ + (picture_.x_label.empty() && !axes_.x_ticks.exponent ? 0 : 1.35 * em_) + 1.6 * em_ : 0.2 * em_;
      room_.bottom = std::max(room_.bottom, frame_.least.below);
      room_.right = picture_.width - std::max(0.6 * em_ + widest_label(axes_.x_ticks, em_) / 2, frame_.least.right);
      room_.top = picture_.height - 0.9 * em_ - (picture_.title.empty() ? 0 : 1.9 * em_) - legend_height - strip_height();
      room_.top = std::min(room_.top, picture_.height - frame_.least.above);
      if (frame_.alone && equal()) make_square();
    }
    x.from = room_.left, x.to = room_.right;
    y.from = room_.bottom, y.to = room_.top;
  }

  bool equal() const { return !axes_.x.log && !axes_.y.log && picture_.x_range && picture_.x_range == picture_.y_range; }

  void make_square() {
    const double side = std::min(room_.width(), room_.height());
    indent_ = (room_.width() - side) / 2;
    room_ = {room_.left + indent_, room_.bottom, room_.right - indent_, room_.bottom + side};
  }

  // From x_low to x_high at every point that the axes show.
  std::vector<std::array<Point, 2>> whiskers(const SeriesPicture& s) const {
    std::vector<std::array<Point, 2>> out;
    for (std::size_t i = 0; i < s.x_low.size(); ++i)
      if (axes_.x.shows(s.x_low[i]) && axes_.x.shows(s.x_high[i]) && axes_.y.shows(s.y[i])) out.push_back({axes_.at(s.x_low[i], s.y[i]), axes_.at(s.x_high[i], s.y[i])});
    return out;
  }

  void occupy() {
    for (const SeriesPicture& s : picture_.series) {
      for (const auto& [from, to] : whiskers(s)) occupied_.add({from, to}, room_);
      for (const auto* values : {&s.y, &s.low, &s.high})
        for (const auto& curve : curves(s.x, *values, axes_)) occupied_.add(curve, room_);
    }
  }

  void draw_front(const Look& look) {
    if (!look.data.front) return;
    for (const auto& curve : curves(look.data.x, look.data.y, axes_)) {
      canvas_.polyline(curve, pen_.front_width(), front_yellow);
      for (const Point& end : {curve.front(), curve.back()}) canvas_.disc(end, pen_.front_width() / 2, front_yellow);
    }
  }

  // With caps.
  void draw_whiskers(const Look& look) {
    const double width = 0.8 * pen_.line_width();
    const Point cap{0, 0.22 * em_};
    for (const auto& ends : whiskers(look.data)) {
      canvas_.line(ends[0], ends[1], width, look.colour);
      for (const Point& end : ends) canvas_.line(end - cap, end + cap, width, look.colour);
    }
  }

  void draw_spread(const Look& look) {
    const SeriesPicture& s = look.data;
    if (s.low.empty()) return;
    const double least = std::max(axes_.y.low * 1e-6, std::numeric_limits<double>::denorm_min());
    const auto at = [&](std::size_t i, double v) { return axes_.at(s.x[i], axes_.y.log ? std::max(v, least) : v); };
    for (std::size_t i = 0; i + 1 < s.x.size(); ++i)
      if (axes_.x.shows(s.x[i]) && axes_.x.shows(s.x[i + 1]))
        canvas_.convex(std::array{at(i, s.low[i]), at(i + 1, s.low[i + 1]), at(i + 1, s.high[i + 1]), at(i, s.high[i])}, look.colour, 0.2);
  }

  void draw_line(const Look& look) {
    const SeriesPicture& s = look.data;
    if (s.front || (s.style == SeriesStyle::points && !s.reference)) return;
    for (const auto& curve : curves(s.x, s.y, axes_)) pen_.stroke(canvas_, curve, look);
  }

  void draw_markers(const Look& look) {
    const SeriesPicture& s = look.data;
    if (s.style == SeriesStyle::line || s.reference || s.front) return;
    for (const auto& curve : curves(s.x, s.y, axes_)) {
      // A line needs no marker at every one of many points; points alone do.
      const bool thin = s.style == SeriesStyle::both && dense(curve, pen_.marker_size(s));
      const double spacing = thin ? 0.08 * room_.width() : 0;
      Point last{-1e9, -1e9};
      for (const Point& p : curve) {
        if (!room_.holds(p, 0.5) || length(p - last) < spacing) continue;
        pen_.mark(canvas_, look, p);
        last = p;
      }
    }
  }

  double strip_height() const { return failed_.empty() ? 0 : strip_gap * em_ + std::max(2.3, 0.4 + 0.8 * static_cast<double>(failed_.size())) * em_; }

  // Above a break of the y axis: where there is no ordinate.
  void draw_strip() {
    if (failed_.empty()) return;
    const double foot = room_.top + strip_gap * em_;
    const Axes strip{{room_.left, foot, room_.right, room_.top + strip_height()}, axes_.x, {}, axes_.x_ticks, {}, em_};
    draw_grid(canvas_, strip);
    const Point stroke{0.3 * em_, 0.12 * em_}, words{room_.left - 0.4 * em_, strip.room.centre().y};
    for (const double x : {room_.left, room_.right})
      for (const double y : {room_.top, foot}) canvas_.line(Point{x, y} - stroke, Point{x, y} + stroke, std::max(1.2, em_ / 18), axes_ink);
    canvas_.text(words, "not", {.size = small_text * em_, .across = Align::high});
    canvas_.text(words, "converged", {.size = small_text * em_, .across = Align::high, .up = Align::high});
    for (std::size_t row = 0; row < failed_.size(); ++row) {
      const double y = foot + strip.room.height() * (static_cast<double>(row) + 0.5) / static_cast<double>(failed_.size());
      for (const double x : failed_[row].data.x)
        if (const Point at{axes_.x.shows(x) ? axes_.x.pixel(x) : -1e9, y}; strip.room.holds(at, 0.5)) pen_.mark(canvas_, failed_[row], at);
    }
    draw_frame(canvas_, strip);
  }

  void draw_axes() {
    draw_grid(canvas_, axes_);
    draw_ticks(canvas_, axes_, frame_.x_labels);
    draw_names();
    const FittedText title = fitted(picture_.title, 1.1 * em_, picture_.width - em_, true);
    canvas_.text({within(title, true), picture_.height - 0.6 * em_}, title, title_style());
  }

  // Lines one below the other need no more room than one: their letters are half as high.
  void draw_names() {
    const FittedText x = fitted(frame_.x_labels ? picture_.x_label : "", em_, picture_.width - em_, false, frame_.x_labels ? axis_name("", axes_.x_ticks) : "");
    canvas_.text({within(x), 0.4 * em_ + x.depth()}, x, {.across = Align::middle});
    const FittedText y = fitted(picture_.y_label, em_, room_.height(), false, axis_name("", axes_.y_ticks));
    canvas_.text({indent_ + 0.45 * em_, room_.centre().y}, y, {.up = Align::middle, .upright = true});
  }

  // The middle of the plot, unless the text is so long that the whole width is needed.
  double within(const FittedText& text, bool bold = false) const {
    double half = 0;
    for (const std::string& line : text.lines) half = std::max(half, text_extent(line, text.size, bold).x / 2);
    half += text.lines.size() > 1 ? 0.5 * em_ : 2;  // off the edge
    return std::clamp(room_.centre().x, half, std::max(half, picture_.width - half));
  }

  const ChartPicture& picture_;
  Canvas& canvas_;
  ChartFrame frame_;
  double em_;
  Pen pen_;
  std::vector<Look> looks_, failed_;  // of all series, of those of the strip
  Axes axes_;
  Box& room_ = axes_.room;
  double indent_ = 0;  // of a plot narrower than it might be
  Occupied occupied_;
};

}  // namespace

bool same_legend(const ChartPicture& a, const ChartPicture& b) {
  const std::vector<Look> one = named(a), other = named(b);
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const Look& x, const Look& y) {
    const auto look = [](const Look& l) { return std::tuple(l.data.name, l.marker, l.dashed, l.data.style, l.data.reference, l.data.front, l.data.crossed, l.data.low.empty()); };
    return x.colour == y.colour && look(x) == look(y);
  });
}

Legend chart_legend(const ChartPicture& picture, double em, double width) {
  constexpr double kLetters = 0.92;
  std::vector<LegendEntry> entries;
  for (const Look& look : named(picture)) entries.push_back({look.data.name, [pen = Pen{em}, look](Canvas& canvas, const Box& box) { pen.sample(canvas, look, box); }});
  return Legend(std::move(entries), kLetters * em, width);
}

ChartMargins draw_on(Canvas& canvas, const ChartPicture& picture, const ChartFrame& frame) { return Chart(picture, canvas, frame).margins(); }

void render(const ChartPicture& picture) {
  const ChartFrame frame{letters(picture), {}, true, true};
  ChartPicture grown = picture;
  // Legend and title may leave a plot too low to be legible.
  Canvas tried;
  const ChartMargins margins = draw_on(tried, picture, frame);
  constexpr double kShare = 0.45;  // of the height
  const double least = std::max(least_plot(picture), kShare * picture.height);
  grown.height = std::clamp(static_cast<int>(margins.above + margins.below + least), picture.height, std::max(picture.height, greatest_side));
  Canvas canvas;
  draw_on(canvas, grown, frame);
  write_canvas(canvas, grown);
}

}  // namespace dotyk::figure
