#include "figure/canvas/legend.hpp"

namespace dotyk::figure {

namespace {
constexpr double sample_width = 2.0, gap = 0.45, between = 1.4, row = 1.45, padding = 0.5;  // in em
}

Legend::Legend(std::vector<LegendEntry> entries, double em, double columns_within)
    : entries_(std::move(entries)), em_(em) {
  double x = 0, y = 0;
  std::vector<double> row_ends;  // width of the row of each entry, so far
  for (LegendEntry& entry : entries_) {
    const double sample = (entry.sample ? sample_width + gap : 0) * em;
    if (columns_within > 0) entry.name = shortened(entry.name, em, columns_within - 2 * padding * em - sample);
    const double width = sample + text_extent(entry.name, em).x;
    if (columns_within > 0 && x > 0 && x + width > columns_within - 2 * padding * em) x = 0, y -= row * em;
    places_.push_back({x, y - row * em});
    row_ends.push_back(x + width);
    width_ = std::max(width_, x + width);
    if (columns_within > 0)
      x += width + between * em;
    else
      y -= row * em;
  }
  if (entries_.empty()) return;
  if (columns_within > 0)  // rows stand in the middle
    for (std::size_t i = 0, j = 0; i < places_.size(); i = j) {
      while (j < places_.size() && places_[j].y == places_[i].y) ++j;
      for (std::size_t k = i; k < j; ++k) places_[k].x += (width_ - row_ends[j - 1]) / 2;
    }
  height_ = -places_.back().y + 2 * padding * em;
  width_ += 2 * padding * em;
}

void Legend::draw(Canvas& canvas, Point corner, bool framed) const {
  if (entries_.empty()) return;
  const Box frame{corner.x, corner.y, corner.x + width_, corner.y + height_};
  if (framed) {
    canvas.box(frame, {255, 255, 255}, 0.92);
    canvas.outline(frame, std::max(1.0, em_ / 22), {190, 190, 190});
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    double x = frame.left + padding * em_ + places_[i].x;
    const double y = frame.top - padding * em_ + places_[i].y;
    if (entries_[i].sample) {
      entries_[i].sample(canvas, {x, y, x + sample_width * em_, y + row * em_});
      x += (sample_width + gap) * em_;
    }
    canvas.text({x, y + 0.5 * row * em_}, entries_[i].name, {.size = em_, .up = Align::middle});
  }
}

}  // namespace dotyk::figure
