#include "chart_column.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "chart_layout.hpp"
#include "figures.hpp"

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
  TextStyle style;
  style.size = fitting_size(picture.title, 1.15 * em, picture.width - em, true);
  style.bold = true;
  style.across = Align::middle;
  style.up = Align::high;
  canvas.text({picture.width / 2.0, picture.height - 0.6 * em}, picture.title, style);
  return 1.9 * em;
}

}  // namespace

void draw_charts(const ChartColumn& picture) {
  const auto n = static_cast<double>(picture.panels.size());
  const double em = std::min(0.022 * picture.width, 0.075 * picture.height / n);
  Canvas canvas(oversampling(picture.width, picture.height));
  // The last panel has the numbers and the name of a shared axis beside an equal share.
  const double top = draw_title(canvas, picture, em), below = picture.shared_x ? 3.15 * em : 0, share = (picture.height - top - below) / n;
  std::vector<ChartPicture> panels = picture.panels;
  std::vector<ChartFrame> frames(panels.size(), {em, {}, !picture.shared_x});
  for (ChartPicture& panel : panels) {
    panel.width = picture.width, panel.height = static_cast<int>(share);
    if (picture.shared_x) panel.x_range = common_x(picture.panels);
  }
  panels.back().height += static_cast<int>(below);
  frames.back().x_labels = true;
  ChartMargins least;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Canvas tried(1);
    const ChartMargins margins = draw_on(tried, panels[i], frames[i]);
    least = {std::max(least.left, margins.left), std::max(least.right, margins.right)};
  }
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
