#include "figure/chart/chart.hpp"

#include <array>
#include <cmath>

namespace dotyk::figure {

namespace {

// The curve of nearest slope, in pixels; all where there is none.
Occupied like(const ChartPicture& picture, double slope, const Axes& axes, const Occupied& occupied) {
  std::vector<std::vector<Point>> all;
  for (const SeriesPicture& s : picture.series)
    if (!s.reference)
      for (auto& curve : curves(s.x, s.y, axes)) all.push_back(std::move(curve));
  const std::vector<Point>* best = nearest_slope(all, slope);
  if (!best) return occupied;
  Occupied out;
  out.add(*best, axes.room);
  return out;
}

bool draw_guide(Canvas& canvas, const ChartPicture& picture, const SlopeGuide& guide, double share, const Axes& axes, Occupied& occupied) {
  const double ratio = steepness(axes.x, axes.y, guide.slope);
  double run = share * axes.room.width();
  if (std::abs(ratio) * run > 1.6 * share * axes.room.height()) run = 1.6 * share * axes.room.height() / std::abs(ratio);
  const double rise = ratio * run, up = std::abs(rise);
  const bool plain = guide.label.empty();
  const std::string label = plain ? number(guide.slope) : guide.label;
  const double size = small_text * axes.em;
  const Point extent = text_extent(label, size);
  const double pad = 0.35 * axes.em;
  // With room for the labels on the right, and on the level side: below where the line rises, else above.
  const double width = run + extent.x + 2 * pad, height = up + 1.2 * axes.em + pad;
  const std::optional<Point> place = near_place(occupied, like(picture, ratio, axes, occupied), axes.room, {width, height}, 0.5 * axes.em);
  if (!place) return false;
  const Point at = *place;
  occupied.add(Box{at.x, at.y, at.x + width, at.y + height});
  const double y0 = at.y + (rise >= 0 ? 1.2 * axes.em : pad);
  const Point a{at.x, rise >= 0 ? y0 : y0 + up}, b{at.x + run, rise >= 0 ? y0 + up : y0};
  const Point corner{b.x, a.y};
  const std::array<Point, 3> triangle{a, corner, b};
  canvas.convex(triangle, {235, 235, 235});
  canvas.polyline(triangle, std::max(1.2, axes.em / 16), reference_grey, {}, true);
  canvas.text({b.x + pad, y0 + up / 2}, label, {.size = size, .up = Align::middle, .colour = reference_grey});
  if (plain)
    canvas.text({at.x + run / 2, rise >= 0 ? y0 - 0.15 * axes.em : a.y + 0.1 * axes.em}, "1",
                {.size = size, .across = Align::middle, .up = rise >= 0 ? Align::high : Align::low, .colour = reference_grey});
  return true;
}

}  // namespace

void draw_guide(Canvas& canvas, const ChartPicture& picture, const SlopeGuide& guide, const Axes& axes, Occupied& occupied) {
  for (const double share : {0.16, 0.11, 0.07})
    if (draw_guide(canvas, picture, guide, share, axes, occupied)) return;
}

}  // namespace dotyk::figure
