#include "figure/scene/spread.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace dotyk::figure {

namespace {

using Numbers = std::vector<std::size_t>;

Numbers greedy(const std::vector<Point>& at, const Numbers& order, double spacing) {
  // Kept points by squares of side `spacing`: only neighbours are compared.
  std::unordered_map<long long, Numbers> squares;
  const auto key = [](long long i, long long j) { return i * 1000003LL + j; };
  Numbers kept;
  for (const std::size_t i : order) {
    if (!(std::abs(at[i].x) < 1e7 && std::abs(at[i].y) < 1e7)) continue;
    const auto sx = static_cast<long long>(std::floor(at[i].x / spacing)), sy = static_cast<long long>(std::floor(at[i].y / spacing));
    bool free = true;
    for (long long dx = -1; dx <= 1 && free; ++dx)
      for (long long dy = -1; dy <= 1 && free; ++dy) {
        const auto found = squares.find(key(sx + dx, sy + dy));
        if (found == squares.end()) continue;
        for (const std::size_t j : found->second)
          free = free && std::hypot(at[i].x - at[j].x, at[i].y - at[j].y) >= spacing;
      }
    if (!free) continue;
    squares[key(sx, sy)].push_back(i);
    kept.push_back(i);
  }
  return kept;
}

Numbers all(const std::vector<Point>& at) {
  Numbers out(at.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

// From `first` to `last` in steps.
Numbers steps(std::size_t first, std::size_t last, std::size_t stride) {
  Numbers out;
  for (std::size_t i = first; i <= last; i += stride) out.push_back(i);
  return out;
}

// The lines of a grid across one of its coordinates: their places, and which of them each point is on.
struct Lines {
  std::vector<double> at;
  Numbers of;
};

Lines lines(const std::vector<Point>& plan, double Point::*coordinate) {
  std::vector<double> values;
  for (const Point& p : plan) values.push_back(p.*coordinate);
  std::sort(values.begin(), values.end());
  Lines out;
  const double same = 1e-6 * (values.back() - values.front());
  for (const double v : values)
    if (out.at.empty() || v - out.at.back() > same) out.at.push_back(v);
  for (const Point& p : plan) {
    const auto next = std::upper_bound(out.at.begin(), out.at.end(), p.*coordinate);
    out.of.push_back(static_cast<std::size_t>(next - out.at.begin()) - 1);
  }
  return out;
}

// Points of a grid, or of a part of it, by their lines.
class Grid {
public:
  // None: the points are no grid's.
  static std::optional<Grid> of(const std::vector<Point>& plan) {
    if (plan.size() < 4) return std::nullopt;
    Grid grid{lines(plan, &Point::x), lines(plan, &Point::y), {}};
    if (grid.across_.at.size() * grid.up_.at.size() > 4 * plan.size()) return std::nullopt;
    for (std::size_t i = 0; i < plan.size(); ++i)
      if (!grid.points_.emplace(std::pair{grid.across_.of[i], grid.up_.of[i]}, i).second) return std::nullopt;
    return grid;
  }

  // The points on lines that are apart in both directions, drawn at `at`.
  Numbers on_lines(const std::vector<Point>& at, double spacing) const {
    const std::vector<bool> across = kept(at, spacing, true), up = kept(at, spacing, false);
    Numbers out;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (across[across_.of[i]] && up[up_.of[i]]) out.push_back(i);
    return out;
  }

private:
  Grid(Lines across, Lines up, std::map<std::pair<std::size_t, std::size_t>, std::size_t> points)
      : across_(std::move(across)), up_(std::move(up)), points_(std::move(points)) {}

  // As far from each other as their nearest points.
  std::vector<bool> kept(const std::vector<Point>& at, double spacing, bool across) const {
    const std::size_t n = (across ? across_ : up_).at.size();
    std::vector<double> step(n, spacing);
    std::vector<bool> known(n, false);
    for (const auto& [place, i] : points_) {
      const auto next = points_.find(across ? std::pair{place.first + 1, place.second} : std::pair{place.first, place.second + 1});
      if (next == points_.end()) continue;
      const std::size_t k = across ? place.first : place.second;
      const double far = std::hypot(at[i].x - at[next->second].x, at[i].y - at[next->second].y);
      step[k] = known[k] ? std::min(step[k], far) : far;
      known[k] = true;
    }
    std::vector<Point> places(1);
    for (std::size_t k = 0; k + 1 < n; ++k) places.push_back({places.back().x + step[k], 0});
    std::vector<bool> out(n, false);
    for (const std::size_t k : spread(places, spacing)) out[k] = true;
    return out;
  }

  Lines across_, up_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> points_;
};

}  // namespace

std::vector<std::size_t> spread(const std::vector<Point>& at, double spacing) {
  const Numbers kept = greedy(at, all(at), spacing);
  if (kept.size() < 3 || kept.size() == at.size()) return kept;
  const auto apart = [&](const Numbers& chosen) { return greedy(at, chosen, 0.85 * spacing).size() == chosen.size(); };
  const std::size_t last = at.size() - 1, least = (last + kept.size() - 2) / (kept.size() - 1);
  std::size_t stride = least;
  while (2 * stride <= 3 * least && last % stride != 0) ++stride;
  if (last % stride == 0 && 2 * stride <= 3 * least)
    if (const Numbers even = steps(0, last, stride); apart(even)) return even;
  stride = last / (kept.size() - 1);
  if (const Numbers even = steps(last % stride / 2, last, stride); apart(even)) return even;
  return kept;
}

std::vector<std::size_t> spread(const std::vector<Point>& at, const std::vector<Point>& plan, double spacing) {
  if (const std::optional<Grid> grid = Grid::of(plan))
    // A view may bring the diagonals of a grid nearer to each other than its lines.
    for (const double wider : {1.0, 1.3, 1.7, 2.2}) {
      const Numbers chosen = grid->on_lines(at, wider * spacing);
      if (greedy(at, chosen, 0.8 * spacing).size() == chosen.size()) return chosen;
    }
  return spread(at, spacing);
}

}  // namespace dotyk::figure
