// Which of many places get a symbol, so that symbols stand apart and evenly.
#include "figure/scene/stage.hpp"

#include <map>
#include <numeric>

namespace dotyk::figure {

namespace {

using Numbers = std::vector<std::size_t>;

// In this order, those as far as `spacing` from all taken before.
Numbers greedy(const std::vector<Point>& at, const Numbers& order, double spacing) {
  Numbers kept;
  for (const std::size_t i : order) {
    const bool near = std::abs(at[i].x) < 1e7 && std::abs(at[i].y) < 1e7;
    if (near && std::all_of(kept.rbegin(), kept.rend(), [&](std::size_t j) { return length(at[i] - at[j]) >= spacing; })) kept.push_back(i);
  }
  return kept;
}

// From `first` to `last` in steps.
Numbers steps(std::size_t first, std::size_t last, std::size_t stride) {
  Numbers out;
  for (std::size_t i = first; i <= last; i += stride) out.push_back(i);
  return out;
}

// Which of the lines of a grid across one of its coordinates each point is on.
Numbers lines(const std::vector<Point>& plan, double Point::*coordinate) {
  std::vector<double> values, at;
  for (const Point& p : plan) values.push_back(p.*coordinate);
  std::sort(values.begin(), values.end());
  const double same = 1e-6 * (values.back() - values.front());
  for (const double v : values)
    if (at.empty() || v - at.back() > same) at.push_back(v);
  Numbers out;
  for (const Point& p : plan) out.push_back(static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), p.*coordinate) - at.begin()) - 1);
  return out;
}

// The points of a grid, or of a part of it, by their two lines.
using Grid = std::map<std::array<std::size_t, 2>, std::size_t>;

// Empty: the points are no grid's.
Grid grid_of(const std::vector<Point>& plan) {
  if (plan.size() < 4) return {};
  const Numbers across = lines(plan, &Point::x), up = lines(plan, &Point::y);
  if ((*std::max_element(across.begin(), across.end()) + 1) * (*std::max_element(up.begin(), up.end()) + 1) > 4 * plan.size()) return {};
  Grid grid;
  for (std::size_t i = 0; i < plan.size(); ++i) grid.emplace(std::array{across[i], up[i]}, i);
  return grid.size() == plan.size() ? grid : Grid{};
}

// Of the lines in one direction those that stand apart; two are as far from each other as their nearest points, drawn at `at`.
std::vector<bool> lines_apart(const Grid& grid, const std::vector<Point>& at, double spacing, int direction) {
  std::vector<double> step;  // to the next line
  for (const auto& [place, i] : grid) {
    const std::size_t line = place[direction];
    step.resize(std::max(step.size(), line + 1), INFINITY);
    auto beside = place;
    ++beside[direction];
    if (const auto next = grid.find(beside); next != grid.end()) step[line] = std::min(step[line], length(at[i] - at[next->second]));
  }
  std::vector<Point> places(1);
  for (std::size_t k = 0; k + 1 < step.size(); ++k) places.push_back({places.back().x + (step[k] < INFINITY ? step[k] : spacing), 0});
  std::vector<bool> out(step.size(), false);
  for (const std::size_t k : spread(places, spacing)) out[k] = true;
  return out;
}

}  // namespace

std::vector<std::size_t> spread(const std::vector<Point>& at, double spacing) {
  Numbers all(at.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Numbers kept = greedy(at, all, spacing);
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
  // A view may bring the diagonals of a grid nearer to each other than its lines.
  if (const Grid grid = grid_of(plan); !grid.empty())
    for (const double wider : {1.0, 1.3, 1.7, 2.2}) {
      const std::vector<bool> across = lines_apart(grid, at, wider * spacing, 0), up = lines_apart(grid, at, wider * spacing, 1);
      Numbers chosen;
      for (const auto& [place, i] : grid)
        if (across[place[0]] && up[place[1]]) chosen.push_back(i);
      std::sort(chosen.begin(), chosen.end());
      if (greedy(at, chosen, 0.8 * spacing).size() == chosen.size()) return chosen;
    }
  return spread(at, spacing);
}

}  // namespace dotyk::figure
