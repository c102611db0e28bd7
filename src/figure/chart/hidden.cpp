#include "figure/chart/hidden.hpp"

#include <utility>

namespace dotyk::figure {

Neighbourhood::Neighbourhood(const Box& room, double reach)
    : room_(room), cell_(reach / 2), reach_(reach), columns_(1 + std::max(0, static_cast<int>(room.width() / cell_))), rows_(1 + std::max(0, static_cast<int>(room.height() / cell_))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void Neighbourhood::add(Point p) {
  if (!room_.holds(p)) return;
  cells_[static_cast<std::size_t>((p.y - room_.bottom) / cell_) * columns_ + static_cast<std::size_t>((p.x - room_.left) / cell_)] = true;
}

void Neighbourhood::add(const std::vector<Point>& curve) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    Point p = curve[i], q = curve[i + 1];
    if (!crop(p, q, room_)) continue;
    const int n = 1 + static_cast<int>(length(q - p) / cell_);
    for (int k = 0; k <= n; ++k) add(part_way(p, q, static_cast<double>(k) / n));
  }
}

bool Neighbourhood::holds(Point p) const {
  const int column = static_cast<int>((p.x - room_.left) / cell_), row = static_cast<int>((p.y - room_.bottom) / cell_);
  for (int j = std::max(0, row - 2); j <= std::min(rows_ - 1, row + 2); ++j)
    for (int i = std::max(0, column - 2); i <= std::min(columns_ - 1, column + 2); ++i)
      if (cells_[static_cast<std::size_t>(j) * columns_ + i] && length(Point{room_.left + (i + 0.5) * cell_, room_.bottom + (j + 0.5) * cell_} - p) <= reach_) return true;
  return false;
}

namespace {

double length_of(const std::vector<Point>& curve) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) sum += length(curve[i] - curve[i - 1]);
  return sum;
}

}  // namespace

std::vector<std::vector<Point>> sampled(const std::vector<Point>& curve, const Box& room) {
  constexpr double kSpacing = 3;
  std::vector<std::vector<Point>> out;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    Point p = curve[i], q = curve[i + 1];
    const bool seen = crop(p, q, room);
    if (seen) {
      if (!goes_on) out.push_back({p});
      const int n = 1 + static_cast<int>(length(q - p) / kSpacing);
      for (int k = 1; k <= n; ++k) out.back().push_back(part_way(p, q, static_cast<double>(k) / n));
    }
    goes_on = seen && room.holds(curve[i + 1]);
  }
  return out;
}

std::vector<HiddenPart> hidden_parts(const std::vector<Point>& curve, const std::vector<Neighbourhood>& later, const Box& room, double least) {
  std::vector<HiddenPart> out;
  const auto finish = [&](HiddenPart part) {
    if (part.depth > 0 && length_of(part.points) >= least) out.push_back(std::move(part));
  };
  for (const std::vector<Point>& part : sampled(curve, room)) {
    HiddenPart now;
    for (const Point& p : part) {
      const auto depth = static_cast<int>(std::ranges::count_if(later, [&](const Neighbourhood& n) { return n.holds(p); }));
      if (depth != now.depth) finish(std::exchange(now, {{}, depth}));
      now.points.push_back(p);
    }
    finish(now);
  }
  return out;
}

}  // namespace dotyk::figure
