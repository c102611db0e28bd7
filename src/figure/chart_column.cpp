#include "chart_column.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "chart_layout.hpp"
#include "figures.hpp"
#include "text_fit.hpp"

namespace dotyk::figure {

namespace {

// The least and greatest x of all.
std::array<double, 2> common_x(const std::vector<ChartPicture>& panels) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ChartPicture& panel : panels) {
    const Axis axis = fit_axis(panel, false);
    range = {std::min(range[0], axis.low), std::max(range[1], axis.high)};
  }
  return range;
}

// Over all panels; returns the height it takes.
double draw_title(Canvas& canvas, const ChartColumn& picture, double em) {
  if (picture.title.empty()) return 0;
  const FittedText title = fitted(picture.title, 1.15 * em, picture.width - em, true);
  draw_lines(canvas, {picture.width / 2.0, picture.height - 0.6 * em}, title, title_style());
  return 1.9 * em;
}

// Gives the panels heights with which their plots are equally high, whatever stands above and below; the margins left and
// right that suffice for all.
ChartMargins share(std::vector<ChartPicture>& panels, const std::vector<ChartFrame>& frames, double height) {
  ChartMargins least;
  std::vector<double> beside;
  double plots = height;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Canvas tried(1);
    const ChartMargins margins = draw_on(tried, panels[i], frames[i]);
    least.left = std::max(least.left, margins.left), least.right = std::max(least.right, margins.right);
    beside.push_back(margins.above + margins.below);
    plots -= beside.back();
  }
  for (std::size_t i = 0; i < panels.size(); ++i)
    panels[i].height = static_cast<int>(beside[i] + std::max(2.0, plots / static_cast<double>(panels.size())));
  return least;
}

}  // namespace

void draw_charts(const ChartColumn& picture) {
  const std::size_t n = picture.panels.size();
  const double em = std::min(0.022 * picture.width, 0.075 * picture.height / static_cast<double>(n));
  Canvas canvas(oversampling(picture.width, picture.height));
  const double height = picture.height - draw_title(canvas, picture, em);
  std::vector<ChartPicture> panels = picture.panels;
  std::vector<ChartFrame> frames(panels.size(), {em, {}, !picture.shared_x});
  for (ChartPicture& panel : panels) {
    panel.width = picture.width, panel.height = static_cast<int>(height / static_cast<double>(n));
    if (picture.shared_x) panel.x_range = common_x(picture.panels);
  }
  frames.back().x_labels = true;
  ChartMargins least;
  for (int round = 0; round < 2; ++round) least = share(panels, frames, height);
  double bottom = 0;
  for (std::size_t i = panels.size(); i-- > 0;) {
    canvas.origin({0, bottom});
    frames[i].least = least;
    draw_on(canvas, panels[i], frames[i]);
    bottom += panels[i].height;
  }
  write_canvas(canvas, picture.width, picture.height, picture.file);
}

}  // namespace dotyk::figure
