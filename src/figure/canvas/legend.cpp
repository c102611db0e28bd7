#include "figure/canvas/legend.hpp"

namespace dotyk::figure {

namespace {

constexpr double gap = 0.45, between = 1.4, row = 1.45, padding = 0.5;  // in em

double width_of(const LegendEntry& entry, double em) { return (entry.sample ? entry.width + gap : 0) * em + text_extent(entry.name, em).x; }

// The row of each entry if rows are filled one after the other.
std::vector<std::size_t> rows_within(const std::vector<LegendEntry>& entries, double em, double width) {
  std::vector<std::size_t> out;
  double x = 0;
  for (const LegendEntry& entry : entries) {
    const double end = x + width_of(entry, em);
    const bool next = x > 0 && end > width;
    out.push_back((out.empty() ? 0 : out.back()) + next);
    x = (next ? width_of(entry, em) : end) + between * em;
  }
  return out;
}

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double em, double rows_within_pixels) : entries_(std::move(entries)), em_(em) {
  if (entries_.empty()) return;
  const double room = rows_within_pixels - 2 * padding * em;
  if (rows_within_pixels > 0)
    for (LegendEntry& entry : entries_) {
      if (const double over = width_of(entry, em) - room; over > lack_.pixels) lack_ = {over, entry.name};
      entry.name = shortened(entry.name, em, room - (entry.sample ? entry.width + gap : 0) * em);
    }
  // As few rows as hold all entries; these stand in columns if columns need no more rows.
  const std::size_t rows = rows_within_pixels > 0 ? rows_within(entries_, em, room).back() + 1 : entries_.size();
  const std::vector<LegendEntry> given = entries_;
  place_in_columns((entries_.size() + rows - 1) / rows);
  if (rows_within_pixels > 0 && width_ > room) entries_ = given, place_in_rows(rows, room);
  height_ = -places_.back().y + 2 * padding * em;
  width_ += 2 * padding * em;
}

void Legend::place_in_columns(std::size_t columns) {
  places_.assign(entries_.size(), {});
  double x = 0;
  for (std::size_t first = 0; first < columns; ++first) {
    double sample = 0, widest = 0;
    for (std::size_t i = first; i < entries_.size(); i += columns) sample = std::max(sample, entries_[i].sample ? entries_[i].width : 0);
    for (std::size_t i = first; i < entries_.size(); i += columns) {
      entries_[i].width = sample;
      widest = std::max(widest, width_of(entries_[i], em_));
      places_[i] = {x, -row * em_ * static_cast<double>(i / columns + 1)};
    }
    width_ = x + widest;
    x = width_ + between * em_;
  }
}

// Rows of about equal length, centred.
void Legend::place_in_rows(std::size_t rows, double width) {
  while (rows < entries_.size() && rows_within(entries_, em_, width - 0.5 * em_).back() + 1 == rows) width -= 0.5 * em_;
  const std::vector<std::size_t> of = rows_within(entries_, em_, width);
  std::vector<double> ends(rows, 0);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const double x = ends[of[i]] + (i > 0 && of[i] == of[i - 1] ? between * em_ : 0);
    places_[i] = {x, -row * em_ * static_cast<double>(of[i] + 1)};
    ends[of[i]] = x + width_of(entries_[i], em_);
  }
  width_ = *std::ranges::max_element(ends);
  for (std::size_t i = 0; i < entries_.size(); ++i) places_[i].x += (width_ - ends[of[i]]) / 2;
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
      entries_[i].sample(canvas, {x, y, x + entries_[i].width * em_, y + row * em_});
      x += (entries_[i].width + gap) * em_;
    }
    canvas.text({x, y + 0.5 * row * em_}, entries_[i].name, {.size = em_, .up = Align::middle});
  }
}

}  // namespace dotyk::figure
