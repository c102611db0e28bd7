#include <numeric>

#include "figure/canvas/paper.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/chart/chart.hpp"
#include "figure/chart/chart_look.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

// The least and greatest x of all.
std::array<double, 2> common_x(const std::vector<ChartPicture>& panels) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const ChartPicture& panel : panels) {
    const Axis axis = fit_axis(panel, Side::below);
    range = {std::min(range[0], axis.low), std::max(range[1], axis.high)};
  }
  return range;
}

// Of all maps that show the same.
void share_colours(std::vector<ChartPicture>& panels) {
  for (ChartPicture& panel : panels) {
    if (!panel.map || !panel.map->names.empty()) continue;
    std::array<double, 2> range{INFINITY, -INFINITY};
    for (const ChartPicture& other : panels)
      if (other.map && other.map->names.empty() && other.map->label == panel.map->label)
        for (const double v : other.map->values)
          if (!std::isnan(v)) range = {std::min(range[0], v), std::max(range[1], v)};
    if (range[0] <= range[1]) panel.map->range = range;
  }
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Panels row by row; where the maps of each row show the same, it has one bar. All plots are equally high, and their frames stand in line along rows and columns.
class Grid {
public:
  Grid(const ChartColumn& picture, double em, bool legends) : columns_(static_cast<std::size_t>(picture.columns)), em_(em) {
    panels_ = picture.panels;
    share_colours(panels_);
    const bool one = columns_ > 1 && one_bar_a_row();
    for (std::size_t i = 0; one && i < panels_.size(); ++i) bar_ = std::max(bar_, map_bar_width(bar_of(i), em));
    width_ = (picture.width - bar_) / picture.columns;
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      panels_[i].width = static_cast<int>(width_), panels_[i].height = picture.height / static_cast<int>(rows());
      if (picture.shared_x) panels_[i].x_range = common_x(picture.panels);
      frames_.push_back({em, {}, !picture.shared_x || i + columns_ >= panels_.size()});
      frames_.back().legend = legends && !legend_before(i);
      frames_.back().bar = !one;
    }
  }

  // Gives the plots a height with which all panels take `height` pixels, but at least the height `least`. Returns the pixels that the panels then take.
  double fill(double height, double least) {
    double plots = 0;
    left_.assign(columns_, 0), right_ = left_, above_.assign(rows(), 0), below_ = above_;
    for (int round = 0; round < 3; ++round) {
      measure();
      plots = std::max(least, (height - sum(above_) - sum(below_)) / static_cast<double>(rows()));
      for (std::size_t i = 0; i < panels_.size(); ++i) panels_[i].height = static_cast<int>(above_[row(i)] + plots + below_[row(i)]);
    }
    for (std::size_t i = 0; i < panels_.size(); ++i) frames_[i].least = {left_[column(i)], right_[column(i)], below_[row(i)], above_[row(i)]};
    return sum(above_) + sum(below_) + plots * static_cast<double>(rows());
  }

  // `top`: of the first row, above the lower edge of the picture.
  void draw(Canvas& canvas, double top, const Sheet& sheet) const {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      if (column(i) == 0) top -= panels_[i].height;
      canvas.origin({width_ * static_cast<double>(column(i)), top});
      const ChartMargins margins = draw_on(canvas, panels_[i], frames_[i]);
      require_room(sheet, margins, static_cast<int>(columns_));
      const bool last = column(i) + 1 == columns_ || i + 1 == panels_.size();
      if (bar_ > 0 && last) draw_map_bar(canvas, bar_of(i), {{0, margins.below, 0, panels_[i].height - margins.above}, {}, {}, {}, {}, em_}, width_ - margins.right, width_ + bar_);
    }
  }

private:
  // Do the maps of every row show the same?
  bool one_bar_a_row() const {
    return std::ranges::all_of(panels_, [&](const ChartPicture& panel) {
      const auto& first = panels_[row(static_cast<std::size_t>(&panel - panels_.data())) * columns_].map;
      return panel.map && panel.map->names.empty() && first && panel.map->label == first->label && panel.map->unit == first->unit && !panel.polar;
    });
  }
  // The map of a bar that serves all of a panel's row.
  ChartMap bar_of(std::size_t i) const {
    ChartMap out = *panels_[i].map;
    if (out.range) out.values.assign(out.range->begin(), out.range->end());
    return out;
  }

  // Is there a legend that serves this panel beside it on the left, or above it?
  bool legend_before(std::size_t i) {
    legend_of_.push_back(i);
    for (const auto& [there, neighbour] : {std::pair{column(i) > 0, i - 1}, {row(i) > 0, i - columns_}})
      if (there && legend_serves(panels_[legend_of_[neighbour]], panels_[i])) return legend_of_[i] = legend_of_[neighbour], true;
    return false;
  }

  std::size_t rows() const { return (panels_.size() + columns_ - 1) / columns_; }
  std::size_t row(std::size_t i) const { return i / columns_; }
  std::size_t column(std::size_t i) const { return i % columns_; }

  // The margins of a row or column are the greatest of its panels, also of those measured before: a legend that once stood above its plot keeps that room.
  void measure() {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      Canvas tried;
      const ChartMargins margins = draw_on(tried, panels_[i], frames_[i]);
      left_[column(i)] = std::max(left_[column(i)], margins.left), right_[column(i)] = std::max(right_[column(i)], margins.right);
      above_[row(i)] = std::max(above_[row(i)], margins.above), below_[row(i)] = std::max(below_[row(i)], margins.below);
    }
  }

  std::size_t columns_;
  double em_, width_ = 0, bar_ = 0;  // of a panel, and of a bar beside a row
  std::vector<ChartPicture> panels_;
  std::vector<ChartFrame> frames_;
  std::vector<std::size_t> legend_of_;  // the panel whose legend serves each
  std::vector<double> left_, right_, above_, below_;
};

}  // namespace

void render(const ChartColumn& given) {
  ChartColumn picture = given;
  share_looks(picture.panels);
  const double em = letters(picture);
  const FittedText title = fitted(picture.title, 1.15 * em, picture.width - 1.2 * em, true);
  const Legend legend = common_legend(picture.panels, em, picture.width - em);
  const double above = (picture.title.empty() ? 0 : 1.9 * em + title.depth()) + legend.height();
  require_room(picture, {.plot = 1.0 * picture.width, .legend = legend.lack()}, 1);
  Grid grid(picture, em, legend.empty());
  // The picture grows where plots would be too low to be legible.
  const bool polar = std::ranges::any_of(picture.panels, &ChartPicture::polar);
  const double needed = grid.fill(picture.height - above, least_plot(picture) + (polar ? 2 * polar_rim(em).y : 0));
  picture.height = std::clamp(static_cast<int>(std::ceil(needed + above)), picture.height, std::max(picture.height, greatest_side));

  Canvas canvas;
  canvas.text({picture.width / 2.0, picture.height - 0.6 * em}, title, title_style());
  legend.draw(canvas, {(picture.width - legend.width()) / 2, picture.height - above}, false);
  grid.draw(canvas, picture.height - above, picture);
  write_canvas(canvas, picture);
}

}  // namespace dotyk::figure
