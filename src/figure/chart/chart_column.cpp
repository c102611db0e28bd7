
#include "figure/canvas/paper.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/chart/chart.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

// The least and greatest x of all.
std::array<double, 2> common_x(const std::vector<ChartPicture>& panels) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const ChartPicture& panel : panels) {
    const Axis axis = fit_axis(panel, false);
    range = {std::min(range[0], axis.low), std::max(range[1], axis.high)};
  }
  return range;
}

// Over all panels; returns the height it takes.
double draw_title(Canvas& canvas, const ChartColumn& picture, double em) {
  if (picture.title.empty()) return 0;
  canvas.text({picture.width / 2.0, picture.height - 0.6 * em}, fitted(picture.title, 1.15 * em, picture.width - em, true), title_style());
  return 1.9 * em;
}

// Gives the panels heights with which their plots are equally high, whatever stands above and below; the margins left and
// right that suffice for all.
ChartMargins share(std::vector<ChartPicture>& panels, const std::vector<ChartFrame>& frames, double height) {
  ChartMargins least;
  std::vector<double> beside;
  double plots = height;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Canvas tried;
    const ChartMargins margins = draw_on(tried, panels[i], frames[i]);
    least.left = std::max(least.left, margins.left), least.right = std::max(least.right, margins.right);
    beside.push_back(margins.above + margins.below);
    plots -= beside.back();
  }
  for (std::size_t i = 0; i < panels.size(); ++i)
    panels[i].height = static_cast<int>(beside[i] + std::max(2.0, plots / static_cast<double>(panels.size())));
  return least;
}

// One column into its part of the canvas, from `height` downwards.
void draw_column(Canvas& canvas, std::vector<ChartPicture> panels, double left, double bottom, double height, double em, bool shared_x) {
  std::vector<ChartFrame> frames(panels.size(), {em, {}, !shared_x});
  frames.back().x_labels = true;
  ChartMargins least;
  for (int round = 0; round < 2; ++round) least = share(panels, frames, height);
  for (std::size_t i = panels.size(); i-- > 0;) {
    canvas.origin({left, bottom});
    frames[i].least = least;
    draw_on(canvas, panels[i], frames[i]);
    bottom += panels[i].height;
  }
}

}  // namespace

void render(const ChartColumn& given) {
  ChartColumn picture = given;
  const auto columns = static_cast<std::size_t>(picture.columns), rows = (picture.panels.size() + columns - 1) / columns;
  picture.height = tall_enough(picture, static_cast<double>(rows));
  const double width = static_cast<double>(picture.width) / picture.columns;
  const double em = letters(picture);
  Canvas canvas;
  const double height = (picture.height - draw_title(canvas, picture, em)) / static_cast<double>(rows);
  for (std::size_t column = 0; column < columns; ++column) {
    std::vector<ChartPicture> panels;
    for (std::size_t i = column; i < picture.panels.size(); i += columns) {
      ChartPicture& panel = panels.emplace_back(picture.panels[i]);
      panel.width = static_cast<int>(width), panel.height = static_cast<int>(height);
      if (picture.shared_x) panel.x_range = common_x(picture.panels);
    }
    const double used = height * static_cast<double>(panels.size());
    draw_column(canvas, panels, width * static_cast<double>(column), height * static_cast<double>(rows) - used, used, em, picture.shared_x);
  }
  write_canvas(canvas, picture);
}

}  // namespace dotyk::figure
