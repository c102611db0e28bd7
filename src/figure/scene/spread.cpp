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
  if (kept.size() == at.size()) return kept;
  const auto apart = [&](const Numbers& chosen) { return greedy(at, chosen, 0.85 * spacing).size() == chosen.size(); };
  const std::size_t last = at.size() - 1;
  if (kept.size() < 3) return kept.size() == 2 && apart({0, last}) ? Numbers{0, last} : kept.size() == 1 ? Numbers{last / 2} : kept;
  const std::size_t least = (last + kept.size() - 2) / (kept.size() - 1);
  // Up to both ends, else as far from the one as from the other.
  for (const bool whole : {true, false})
    for (std::size_t stride = whole ? least : last / (kept.size() - 1); 2 * stride <= 3 * least + 1; ++stride) {
      const std::size_t rest = last % stride;
      if (whole ? rest != 0 : rest % 2 != 0) continue;
      if (const Numbers even = steps(rest / 2, last, stride); apart(even)) return even;
    }
  // Uneven places: those nearest to even steps of the way along them.
  std::vector<double> way{0};
  for (std::size_t i = 1; i < at.size(); ++i) way.push_back(way.back() + length(at[i] - at[i - 1]));
  Numbers even;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const double wanted = way.back() * static_cast<double>(k) / static_cast<double>(kept.size() - 1);
    const std::size_t above = std::min<std::size_t>(last, std::ranges::lower_bound(way, wanted) - way.begin());
    even.push_back(above > 0 && wanted - way[above - 1] < way[above] - wanted ? above - 1 : above);
  }
  return apart(even) ? even : kept;
}

std::vector<std::size_t> spread(const std::vector<Point>& all, const std::vector<std::size_t>& candidates, const std::function<double(std::size_t)>& value, double spacing) {
  if (candidates.empty()) return {};
  constexpr double kEqual = 1e-6;
  Bounds bounds;
  std::vector<Point> at;
  for (const std::size_t i : candidates) at.push_back(all[i]), bounds.add(all[i]);
  const double most = value(*std::ranges::max_element(candidates, {}, value));
  const Point peak = all[*std::ranges::find_if(candidates, [&](std::size_t i) { return value(i) >= (1 - kEqual) * most; })], image = 2 * bounds.centre() - peak;
  Numbers out;
  const auto off = [&](std::size_t i, double distance) { return std::ranges::none_of(out, [&](std::size_t j) { return length(at[i] - at[j]) < distance; }); };
  for (const Point p : {peak, Point{image.x, peak.y}, Point{peak.x, image.y}, image}) {
    const std::size_t nearest = std::ranges::min_element(at, {}, [&](Point q) { return length(q - p); }) - at.begin();
    if (length(at[nearest] - p) < spacing / 2 && off(nearest, 0.85 * spacing)) out.push_back(nearest);
  }
  for (const std::size_t i : spread(at, at, spacing))
    if (off(i, 0.85 * spacing)) out.push_back(i);
  for (std::size_t& i : out) i = candidates[i];
  return out;
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
