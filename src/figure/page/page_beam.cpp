// The cell of a beam: its deflection line, exaggerated as far as there is room for supports and loads.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

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

double deflection_at(const BeamDrawing& beam, double x) {
  const auto above = std::lower_bound(beam.x.begin(), beam.x.end(), x);
  const std::size_t j = std::min<std::size_t>(above - beam.x.begin(), beam.x.size() - 1), i = j > 0 ? j - 1 : 0;
  const double span = beam.x[j] - beam.x[i], t = span > 0 ? (x - beam.x[i]) / span : 0;
  return beam.deflection[i] + t * (beam.deflection[j] - beam.deflection[i]);
}

void fit_y(const BeamDrawing& beam, Axes& axes) {
  const std::vector<double> heights = load_heights(beam, axes.em, symbol_em(axes));
  const double height = axes.room.height();
  double most = 0;
  for (const double u : beam.deflection) most = std::max(most, std::abs(u));
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
  if (rests)
    axes.y_ticks = Ticks{{{0, "0"}}, 0};
  else
    axes.y_ticks = few_ticks(axes.y.low, axes.y.high, height / (2.6 * axes.em));
}

void draw_cell(Canvas& canvas, const BeamDrawing& beam, const Axes& axes) {
  const double em = axes.em;
  canvas.clip(axes.room);
  const std::array<double, 2> dash{0.5 * em, 0.3 * em};
  canvas.polyline(std::array{axes.at(0, 0), axes.at(beam.length, 0)}, std::max(1.2, em / 16), {120, 120, 120}, dash);
  draw_distributed_load(canvas, beam, axes);
  canvas.polyline(axes.line(beam.x, beam.deflection), std::max(3.0, em / 4.5), {30, 30, 30});
  draw_supports(canvas, beam, axes);
  draw_point_loads(canvas, beam, axes);
  canvas.no_clip();
}

}  // namespace dotyk::figure
