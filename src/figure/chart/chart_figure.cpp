// Charts, drawn by hand on the canvas: vtkChartXY places curves on a
// logarithmic axis only at its second rendering, and knows neither markers
// that stand off each other nor slope guides.
#include <iterator>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "figure/canvas/paper.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/chart/chart_series.hpp"
#include "figure/chart/chart_texts.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

constexpr double strip_gap = 0.45;   // em, of a break
constexpr double off_edge = 0.6;     // em, that texts keep off the edges of the picture
constexpr double outwards = -0.25;   // em, of ticks beside the cells of a map
constexpr double name_depth = 1.7, labels_depth = 1.6;  // em, of the name of a y axis and of the labels of the x axis

class Chart {
public:
  // Draws itself, from the canvas's origin.
  Chart(const ChartPicture& picture, Canvas& canvas, const ChartFrame& frame)
      : picture_(picture), canvas_(canvas), frame_(frame), em_(frame.em), looks_(looks(picture)), series_(canvas, axes_, looks_, em_), legend_({}, em_) {
    Axes& axes = axes_.left;
    axes.em = em_;
    axes.x = fit_axis(picture, Side::below), axes.y = fit_axis(picture, Side::left);
    if (picture.map) axes.tick = outwards;
    if (picture.y_break) axes.y.left_out = AxisBreak{(*picture.y_break)[0], (*picture.y_break)[1]};
    right_ = std::ranges::any_of(picture.series, &SeriesPicture::right);
    for (const Look& look : looks_)
      if (look.data.y.empty() && !look.data.x.empty()) failed_.push_back(look);
    place(0);
    occupy();
    const std::optional<Point> corner = place_legend();
    draw_axes();
    draw_strip();
    draw_plot();
    draw_frames();
    for (const PlotText& text : texts_) draw(canvas_, text, em_);
    if (corner) {
      const bool inside = corner->y < room_.top - 1;
      legend_.draw(canvas_, *corner, inside);
      if (inside) occupied_.add(Box{corner->x, corner->y, corner->x + legend_.width(), corner->y + legend_.height()});
    }
    for (const SlopeGuide& guide : picture.slopes) draw_guide(canvas_, picture, guide, axes, occupied_);
    if (picture.polar) draw_polar_labels(canvas_, axes, occupied_);
  }

  ChartMargins margins() const { return {room_.left, picture_.width - room_.right, room_.bottom, picture_.height - room_.top - spare_, inner_width(), crowded_note_, legend_.lack()}; }

private:
  // Margins from the widths of what stands in them.
  void place(double legend_height) {
    Axis &x = axes_.left.x, &y = axes_.left.y;
    for (int round = 0; round < 2; ++round) {
      axes_.left.x_ticks = x_ticks();
      axes_.left.y_ticks = y_ticks(y);
      if (right_) axes_.right.y_ticks = y_ticks(axes_.right.y = fit_axis(picture_, Side::right));
      room_.left = std::max(margin_left(), frame_.least.left);
      room_.right = picture_.width - std::max(margin_right(), frame_.least.right);
      room_.bottom = std::max(margin_below(), frame_.least.below);
      room_.top = picture_.height - 0.9 * em_ - (picture_.title.empty() ? 0 : 1.9 * em_ + title().depth()) - legend_height - strip_height();
      room_.top = std::min(room_.top, picture_.height - frame_.least.above);
      if (frame_.alone && (equal() || picture_.polar)) make_square();
    }
    x.from = room_.left, x.to = room_.right;
    y.from = room_.bottom, y.to = room_.top;
    if (y.left_out) share_height(y);
    if (picture_.polar) place_polar(axes_.left);
    const auto [right, ticks] = std::tuple(axes_.right.y, axes_.right.y_ticks);
    axes_.right = axes_.left;
    if (right_) axes_.right.y = right, axes_.right.y.from = y.from, axes_.right.y.to = y.to, axes_.right.y_ticks = ticks;
  }

  Ticks x_ticks() const {
    const Axis& x = axes_.left.x;
    Ticks out;
    for (const std::string& name : picture_.categories) out.ticks.push_back({static_cast<double>(out.ticks.size() + 1), name});
    if (!out.ticks.empty() || picture_.polar) return out;
    const double width = room_.width() > 1 ? room_.width() : 27 * em_;
    if (picture_.map && !x.log) {
      const double widest = widest_label(map_ticks(picture_.map->x, INFINITY), em_);
      if (const Ticks whole = map_ticks(picture_.map->x, width / (widest + 0.5 * em_)); !whole.ticks.empty()) return whole;
    }
    // Within less than a decade steps are even as on a linear axis.
    const bool decades = x.log && std::log10(x.high) - std::log10(x.low) > 0.7;
    return decades ? log_ticks(x.low, x.high, static_cast<int>(std::max(3.0, width / (3.6 * em_))) + 1) : spaced_ticks({x.log, x.low, x.high, 0, width}, em_);
  }

  Ticks y_ticks(const Axis& y) const {
    const double labels = std::max(3.0, room_.height() > 1 ? room_.height() / (2.6 * em_) : 6);
    if (picture_.polar) return {};
    if (picture_.map && !y.log)
      if (const Ticks whole = map_ticks(picture_.map->y, room_.height() > 1 ? room_.height() / em_ : INFINITY); !whole.ticks.empty()) return whole;
    if (y.left_out) return broken_ticks(y, std::min(8.0, labels));
    constexpr double kLine = 1.35;  // em from a power of ten to the next
    return y.log ? log_ticks(y.low, y.high, room_.height() > 1 ? static_cast<int>(std::lround(room_.height() / (kLine * em_))) : 6) : few_ticks(y.low, y.high, std::min(8.0, labels));
  }

  double margin_left() const {
    const Ticks& ticks = axes_.left.y_ticks;
    const double widest = std::max(widest_label(ticks, em_), strip_words().empty() ? 0 : extent_of({small_text * em_, strip_words()}).x);
    return 0.6 * em_ + (picture_.y_label.empty() && !ticks.exponent ? 0 : name_depth * em_ + beyond_two(y_name(axes_.left))) + widest + 0.5 * em_;
  }

  double margin_right() const {
    if (right_) return 0.6 * em_ + (picture_.y_right_label.empty() && !axes_.right.y_ticks.exponent ? 0 : name_depth * em_ + beyond_two(y_name(axes_.right))) + widest_label(axes_.right.y_ticks, em_) + 0.5 * em_;
    const double bar = picture_.map && frame_.bar ? map_bar_width(*picture_.map, em_) : 0;
    return 0.6 * em_ + std::max(bar, picture_.categories.empty() ? widest_label(axes_.left.x_ticks, em_) / 2 : 0);
  }

  double margin_below() const {
    if (!frame_.x_labels) return 0.2 * em_;
    const double name = picture_.x_label.empty() && !axes_.left.x_ticks.exponent ? 0 : 1.35 * em_ + beyond_two(x_name()) + (x_name().lines.size() > 1 ? 0.3 * em_ : 0);
    if (picture_.polar) return 0.6 * em_ + name;
    return 0.4 * em_ + name + (picture_.categories.empty() ? labels_depth * em_ : 0.6 * em_ + category_names().height());
  }

  CategoryNames category_names() const {
    const double width = room_.width() > 1 ? room_.width() : picture_.width - room_.left;
    return {picture_.categories, em_, width / static_cast<double>(picture_.categories.size())};
  }

  bool equal() const { return !axes_.left.x.log && !axes_.left.y.log && picture_.x_range && picture_.x_range == picture_.y_range; }

  // The room beside the circle that the names of angles take, and what they leave.
  Point rim() const { return picture_.polar ? polar_rim(em_) : Point{}; }
  double inner_width() const { return room_.width() - 2 * rim().x; }
  double inner_height() const { return room_.height() - 2 * rim().y; }

  void make_square() {
    const double side = std::min(inner_width(), inner_height());
    indent_ = (inner_width() - side) / 2, spare_ = inner_height() - side;
    room_ = {room_.left + indent_, room_.bottom, room_.right - indent_, room_.bottom + side + 2 * rim().y};
  }

  void share_height(Axis& y) const {
    AxisBreak& b = *y.left_out;
    const double gap = strip_gap * em_;
    b.low = y.from + share_below(y) * (y.to - y.from - gap);
    b.high = b.low + gap;
  }

  void occupy() {
    occupied_ = {};
    series_.occupy(occupied_);
    if (picture_.polar) occupy_polar(axes_.left, occupied_);
    texts_ = plot_texts(picture_, axes_, occupied_, crowded_, crowded_note_);
  }

  // The lower left of the legend: at a free place among the curves; where there is none in rows above them, and all is placed anew.
  std::optional<Point> place_legend() {
    if (!frame_.legend) return std::nullopt;
    legend_ = chart_legend(picture_, em_, 0, crowded_);
    if (legend_.empty()) return std::nullopt;
    const bool covered = picture_.map && !picture_.polar;
    if (const auto corner = free_place(occupied_, room_, {legend_.width(), legend_.height()}, 0.6 * em_); corner && !covered) return corner;
    // Less room may leave names without a place, which the legend then has too.
    for (std::size_t before = picture_.series.size() + 1; before != crowded_.size();) {
      before = crowded_.size();
      legend_ = chart_legend(picture_, em_, picture_.width - em_, crowded_);
      place(legend_.height());
      occupy();
    }
    const double half = legend_.width() / 2;
    return Point{std::clamp(room_.centre().x, half, std::max(half, picture_.width - half)) - legend_.width() / 2, room_.top + strip_height() + 0.1 * em_};
  }

  void draw_plot() {
    canvas_.clip(room_);
    if (picture_.map) draw_map(canvas_, *picture_.map, axes_.left);
    if (picture_.polar) draw_polar_grid(canvas_, axes_.left);
    series_.draw_curves();
    canvas_.no_clip();
    if (const auto& b = axes_.left.y.left_out) canvas_.box({room_.left, b->low, room_.right, b->high}, {255, 255, 255});
    series_.draw_markers();
    if (picture_.map && frame_.bar) draw_map_bar(canvas_, *picture_.map, axes_.left, room_.right, picture_.width);
  }

  double strip_height() const {
    return failed_.empty() ? 0 : (strip_gap + std::max(0.3 + 1.0 * static_cast<double>(strip_words().size()), 0.4 + 0.8 * static_cast<double>(failed_.size()))) * em_;
  }
  // Beside the strip, one below the other.
  std::vector<std::string> strip_words() const {
    constexpr std::size_t kMost = 3;
    std::istringstream words(failed_.empty() ? "" : picture_.strip_label);
    std::vector<std::string> out{std::istream_iterator<std::string>(words), {}};
    return out.size() > kMost ? fitted(picture_.strip_label, small_text * em_, text_extent(picture_.strip_label, small_text * em_).x / 2.5).lines : out;
  }

  // Above a break of the y axis: where there is no ordinate.
  void draw_strip() {
    if (failed_.empty()) return;
    const double foot = room_.top + strip_gap * em_;
    const Axes strip{{room_.left, foot, room_.right, room_.top + strip_height()}, axes_.left.x, {}, axes_.left.x_ticks, {}, em_};
    draw_grid(canvas_, strip);
    const Point words{room_.left - 0.4 * em_, strip.room.centre().y};
    draw_break(room_.top, foot);
    const FittedText label{small_text * em_, strip_words()};
    canvas_.text(words + Point{0, label.depth() / 2}, label, {.across = Align::high, .up = Align::middle});
    for (std::size_t row = 0; row < failed_.size(); ++row) {
      const double y = foot + strip.room.height() * (static_cast<double>(row) + 0.5) / static_cast<double>(failed_.size());
      for (const double x : failed_[row].data.x)
        if (const Point at{axes_.left.x.shows(x) ? axes_.left.x.pixel(x) : -1e9, y}; strip.room.holds(at, 0.5)) Pen{em_}.mark(canvas_, failed_[row], at);
    }
    draw_frame(canvas_, strip);
  }

  // Slanted strokes at both ends of a gap in the y axis.
  void draw_break(double low, double high) {
    const Point stroke{0.3 * em_, 0.12 * em_};
    for (const double x : {room_.left, room_.right})
      for (const double y : {low, high}) canvas_.line(Point{x, y} - stroke, Point{x, y} + stroke, std::max(1.2, em_ / 18), axes_ink);
  }

  void draw_frames() {
    if (picture_.polar) return;
    Axes part = axes_.left;
    if (const auto& b = axes_.left.y.left_out) {
      part.room.top = b->low;
      draw_frame(canvas_, part);
      part.room = {room_.left, b->high, room_.right, room_.top};
      draw_break(b->low, b->high);
    }
    draw_frame(canvas_, part);
  }

  void draw_axes() {
    const Axes& axes = axes_.left;
    if (!picture_.polar) {
      draw_grid(canvas_, axes);
      draw_ticks(canvas_, axes, Side::left);
      draw_ticks(canvas_, axes, Side::below, frame_.x_labels && picture_.categories.empty());
      if (frame_.x_labels && !picture_.categories.empty()) category_names().draw(canvas_, axes);
      if (right_) draw_ticks(canvas_, axes_.right, Side::right, true, right_colour(picture_));
    }
    draw_names();
    const FittedText above = title();
    canvas_.text({within(above, true), picture_.height - 0.6 * em_}, above, title_style());
  }

  FittedText title() const { return fitted(picture_.title, 1.1 * em_, picture_.width - 2 * off_edge * em_, true); }
  FittedText x_name() const { return fitted(frame_.x_labels ? picture_.x_label : "", em_, picture_.width - em_, false, frame_.x_labels ? axis_name("", axes_.left.x_ticks) : ""); }
  FittedText y_name(const Axes& axes) const {
    const double room = room_.height() > 1 ? room_.height() : picture_.height;
    return fitted(&axes == &axes_.left ? picture_.y_label : picture_.y_right_label, em_, room, false, axis_name("", axes.y_ticks));
  }

  // Two lines need no more room than one: their letters are half as high. A third does.
  static double beyond_two(const FittedText& text) {
    const auto lines = static_cast<double>(text.lines.size());
    return lines > 2 ? (lines - 2) / (lines - 1) * text.depth() : 0;
  }

  void draw_names() {
    const FittedText x = x_name();
    canvas_.text({within(x), 0.4 * em_ + x.depth()}, x, {.across = Align::middle});
    canvas_.text({indent_ + 0.45 * em_, room_.centre().y}, y_name(axes_.left), {.up = Align::middle, .upright = true});
    if (!right_) return;
    const FittedText right = y_name(axes_.right);
    const Colour colour = right_colour(picture_);
    TextStyle style{.across = Align::high, .up = Align::middle, .upright = true};
    if (!(colour == axes_ink)) style.colour = colour;
    canvas_.text({picture_.width - 0.45 * em_ - right.depth(), room_.centre().y}, right, style);
  }

  // The middle of the plot, unless the text is so long that the whole width is needed.
  double within(const FittedText& text, bool bold = false) const {
    double half = 0;
    for (const std::string& line : text.lines) half = std::max(half, text_extent(line, text.size, bold).x / 2);
    half += off_edge * em_;
    return std::clamp(room_.centre().x, half, std::max(half, picture_.width - half));
  }

  const ChartPicture& picture_;
  Canvas& canvas_;
  ChartFrame frame_;
  double em_;
  std::vector<Look> looks_, failed_;  // of all series, of those of the strip
  ChartAxes axes_;
  SeriesDrawing series_;
  Legend legend_;
  bool right_ = false;  // is there a y axis on the right?
  Box& room_ = axes_.left.room;
  double indent_ = 0, spare_ = 0;  // of a plot narrower or lower than it might be
  std::vector<PlotText> texts_;
  SeriesSet crowded_;  // reference curves whose names have no place in the plot
  const ChartNote* crowded_note_ = nullptr;
  Occupied occupied_;
};

// The chart in the size that it needs, and its canvas.
std::pair<ChartPicture, Canvas> drawn(const ChartPicture& picture) {
  const ChartFrame frame{letters(picture), {}, true, true};
  ChartPicture grown = picture;
  // Legend and title may leave a plot too low to be legible.
  Canvas tried;
  const ChartMargins margins = draw_on(tried, picture, frame);
  constexpr double kShare = 0.45;  // of the height
  const double least = std::max(least_plot(picture), kShare * picture.height) + (picture.polar ? 2 * polar_rim(frame.em).y : 0);
  grown.height = std::clamp(static_cast<int>(margins.above + margins.below + least), picture.height, std::max(picture.height, greatest_side));
  // Notes without a free place may need a higher picture, too.
  for (int tries = 0; tries < 4 && draw_on(tried, grown, frame).crowded; ++tries) grown.height = std::clamp(grown.height * 6 / 5, grown.height, std::max(grown.height, greatest_side));
  Canvas canvas;
  require_room(picture, draw_on(canvas, grown, frame), 1);
  return {std::move(grown), std::move(canvas)};
}

}  // namespace

void require_room(const Sheet& sheet, const ChartMargins& margins, int columns) {
  if (margins.crowded) throw InputError("the note \"" + margins.crowded->text + "\" has no free place in its plot: give fewer words, or a greater 'size'");
  constexpr double kLeast = 15;  // mm
  const double mm = printed_width(sheet) / sheet.width, needed = std::ceil(printed_width(sheet) + columns * std::max(kLeast - mm * margins.plot, mm * margins.legend.pixels));
  if (margins.legend.pixels > 0) throw InputError(text("the name \"", margins.legend.name, "\" is wider than its chart: give fewer words, or a 'width' of ", needed, " mm"));
  if (mm * margins.plot < kLeast - 0.05)
    throw InputError(text("beside its labels ", std::max(0.0, std::floor(mm * margins.plot)), " mm are left for ", columns > 1 ? "a" : "the", " plot of ", sheet.file, ", at least ", kLeast, " are needed: give ", columns > 1 ? "fewer 'columns' or " : "", "a 'width' of ", needed, " mm"));
}

ChartMargins draw_on(Canvas& canvas, const ChartPicture& picture, const ChartFrame& frame) { return Chart(picture, canvas, frame).margins(); }

void render(const ChartPicture& picture) {
  const auto [grown, canvas] = drawn(picture);
  write_canvas(canvas, grown);
}

std::vector<DataMark> read(const ChartPicture& picture) { return drawn(picture).second.told(); }

}  // namespace dotyk::figure
