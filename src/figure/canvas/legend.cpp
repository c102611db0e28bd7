#include "figure/canvas/legend.hpp"

#include <numbers>

namespace dotyk::figure {
namespace {

double squared_distance(const Box& box, Point p) {
  const double dx = std::max(0.0, std::max(box.left - p.x, p.x - box.right));
  const double dy = std::max(0.0, std::max(box.bottom - p.y, p.y - box.top));
  return dx * dx + dy * dy;
}

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

void Occupied::add(const std::vector<Point>& curve, const Box& inside) {
  constexpr double spacing = 4;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (inside.holds(curve[i])) points_.push_back(curve[i]);
    if (i + 1 == curve.size()) break;
    const Point p = curve[i], q = curve[i + 1];
    const int n = static_cast<int>(std::min(2000.0, length(q - p) / spacing));
    for (int k = 1; k <= n; ++k) {
      const Point between = part_way(p, q, static_cast<double>(k) / (n + 1));
      if (inside.holds(between)) points_.push_back(between);
    }
  }
}

void Occupied::add(const Box& box) {
  const int nx = 1 + static_cast<int>(box.width() / 6), ny = 1 + static_cast<int>(box.height() / 6);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) points_.push_back({box.left + box.width() * i / nx, box.bottom + box.height() * j / ny});
}

bool Occupied::meets(const Box& box) const {
  return std::any_of(points_.begin(), points_.end(), [&](Point p) { return box.holds(p); });
}

bool Occupied::clear_of(const Box& box, double margin) const {
  return std::none_of(points_.begin(), points_.end(), [&](Point p) { return squared_distance(box, p) < margin * margin; });
}

double Occupied::distance(const Box& box) const {
  double least = 1e18;
  for (const Point& p : points_) least = std::min(least, squared_distance(box, p));
  return std::sqrt(least);
}

std::optional<Point> free_place(const Occupied& occupied, const Box& room, Point size, double margin) {
  if (size.x + 2 * margin > 0.7 * room.width() || size.y + 2 * margin > 0.8 * room.height()) return std::nullopt;
  const auto [left, bottom, right, top] = Box{room.left + margin, room.bottom + margin, room.right - margin - size.x, room.top - margin - size.y};
  const double centre = (left + right) / 2, middle = (bottom + top) / 2;
  for (const Point p : {Point{right, top}, {left, top}, {left, bottom}, {right, bottom}, {right, middle}, {left, middle}, {centre, top}, {centre, bottom}})
    if (!occupied.meets(Box{p.x, p.y, p.x + size.x, p.y + size.y}.grown(margin))) return p;
  return std::nullopt;
}

std::optional<Point> near_place(const Occupied& occupied, const Occupied& to, const Box& room, Point size, double margin) {
  constexpr int steps = 40;
  constexpr double kOthers = 2;  // beside another curve it would seem to belong to that
  const double x = room.width() - size.x - 2 * margin, y = room.height() - size.y - 2 * margin;
  if (x < 0 || y < 0) return std::nullopt;
  std::optional<Point> place;
  double best = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Point p{room.left + margin + x * i / steps, room.bottom + margin + y * j / steps};
      const Box block{p.x, p.y, p.x + size.x, p.y + size.y};
      if (!occupied.clear_of(block, margin)) continue;
      const double nearest = occupied.distance(block), own = to.distance(block);
      const double cost = own + kOthers * (own - nearest) + 0.02 * (p.y - room.bottom);
      if (!place || cost < best) best = cost, place = p;
    }
  return place;
}

std::optional<Point> place_beside(const Occupied& occupied, const Box& room, Point at, Point size, double margin) {
  constexpr int rings = 80, angles = 32;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < (ring == 0 ? 1 : angles); ++k) {
      // From above in both senses.
      const double angle = 0.5 * std::numbers::pi + (k % 2 ? 1 : -1) * std::numbers::pi * ((k + 1) / 2) / (0.5 * angles);
      const Point middle = at + 0.3 * ring * size.y * Point{std::cos(angle), std::sin(angle)};
      const Box box = Box::about(middle, size);
      const bool inside = box.left >= room.left + margin && box.right <= room.right - margin && box.bottom >= room.bottom + margin && box.top <= room.top - margin;
      if (inside && occupied.clear_of(box, margin)) return middle;
    }
  return std::nullopt;
}

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
