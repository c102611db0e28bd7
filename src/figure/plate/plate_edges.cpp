#include "figure/plate/plate_edges.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::figure {

namespace {

const double straight = std::cos(35 * std::acos(-1.0) / 180);

double length(const PlateEdge& e) { return std::hypot(e.to[0] - e.from[0], e.to[1] - e.from[1]); }

Vec3 normal(const PlateEdge& e) { return unit({e.to[1] - e.from[1], e.from[0] - e.to[0], 0}); }

bool joined(const PlateEdge& a, const PlateEdge& b) {
  return std::hypot(a.to[0] - b.from[0], a.to[1] - b.from[1]) <= 1e-6 * std::min(length(a), length(b));
}

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

// Of each piece the one that follows it, mostly the next.
std::vector<std::size_t> followers(const std::vector<PlateEdge>& all) {
  std::vector<std::size_t> out(all.size(), nowhere);
  std::size_t first = 0;  // of the present loop
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 < all.size() && joined(all[i], all[i + 1])) {
      out[i] = i + 1;
      continue;
    }
    if (joined(all[i], all[first])) out[i] = first;
    first = i + 1;
  }
  return out;
}

bool smooth(const PlateEdge& a, const PlateEdge& b) { return dot(normal(a), normal(b)) > straight; }

// With samples at both ends.
std::vector<EdgeSample> filled(const PlateEdge& edge) {
  std::vector<EdgeSample> out = edge.samples;
  if (out.empty()) out.emplace_back();
  if (out.front().share > 0) out.insert(out.begin(), out.front()), out.front().share = 0;
  if (out.back().share < 1) out.push_back(out.back()), out.back().share = 1;
  return out;
}

void append(EdgeRun& run, const PlateEdge& edge, const Vec3& at_start, const Vec3& at_end) {
  const Vec3 n = normal(edge);
  for (const EdgeSample& s : filled(edge)) {
    EdgePoint p;
    for (std::size_t c = 0; c < 2; ++c) p.position[c] = edge.from[c] + s.share * (edge.to[c] - edge.from[c]);
    // From the mean at one end to that at the other.
    p.normal = unit(plus(plus(n, plus(at_start, n, -1), std::max(0.0, 1 - 2 * s.share)), plus(at_end, n, -1), std::max(0.0, 2 * s.share - 1)));
    p.deflection = s.deflection, p.reaction = s.reaction, p.status = s.status, p.extrapolated = s.extrapolated;
    run.points.push_back(p);
  }
}

}  // namespace

std::vector<EdgeRun> edge_runs(const PlatePicture& plate) {
  const std::vector<PlateEdge>& all = plate.boundary;
  const std::vector<std::size_t> next = followers(all);
  std::vector<std::size_t> last(all.size(), nowhere);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (next[i] != nowhere) last[next[i]] = i;
  const auto mean = [&](std::size_t i, std::size_t j) {
    return j != nowhere && smooth(all[i], all[j]) ? unit(plus(normal(all[i]), normal(all[j]))) : normal(all[i]);
  };
  std::vector<EdgeRun> runs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool goes_on = i > 0 && next[i - 1] == i && smooth(all[i - 1], all[i]) && all[i - 1].support == all[i].support && all[i - 1].clamped == all[i].clamped;
    if (!goes_on) runs.push_back({all[i].support, all[i].clamped, {}});
    append(runs.back(), all[i], mean(i, last[i]), mean(i, next[i]));
  }
  return runs;
}

Vec3 outwards_at(const std::vector<EdgeRun>& runs, double x, double y) {
  Vec3 sum{0, 0, 0};
  double size = 0;
  for (const EdgeRun& run : runs)
    for (const EdgePoint& p : run.points) size = std::max({size, std::abs(p.position[0] - x), std::abs(p.position[1] - y)});
  for (const EdgeRun& run : runs)
    for (const EdgePoint& p : run.points)
      if (std::hypot(p.position[0] - x, p.position[1] - y) <= 1e-6 * size) sum = plus(sum, p.normal);
  return unit(sum);
}

}  // namespace dotyk::figure
