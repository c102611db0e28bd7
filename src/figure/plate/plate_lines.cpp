#include "figure/plate/plate_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "figure/canvas/geometry.hpp"

namespace dotyk::figure {

namespace {

Vec3 at(const PlatePicture& plate, int i) {
  return {plate.points[2 * i], plate.points[2 * i + 1], plate.deflection[i]};
}

// Crossings of triangle sides, each found once, and the lines between them.
class Crossings {
public:
  Crossings(const PlatePicture& plate, double value) : plate_(plate), value_(value) {}

  void add(int a, int b, int c) {
    std::vector<int> ends;
    for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      if (above(i) != above(j)) ends.push_back(crossing(std::min(i, j), std::max(i, j)));
    if (ends.size() == 2 && ends[0] != ends[1]) edges_.insert(edges_.end(), ends.begin(), ends.end());
  }

  std::vector<PlateLine> lines() const {
    std::vector<PlateLine> out;
    for (const std::vector<int>& chain : chains(edges_)) {
      out.emplace_back();
      for (const int i : chain) out.back().push_back(points_[i]);
    }
    return out;
  }

private:
  double field(int node) const { return plate_.values[node]; }
  bool above(int node) const { return field(node) > value_; }

  int crossing(int i, int j) {
    const auto [found, fresh] = numbers_.try_emplace({i, j}, static_cast<int>(points_.size()));
    if (fresh) {
      const double t = (value_ - field(i)) / (field(j) - field(i));
      points_.push_back(plus(at(plate_, i), plus(at(plate_, j), at(plate_, i), -1), t));
    }
    return found->second;
  }

  const PlatePicture& plate_;
  double value_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<Vec3> points_;
  std::vector<int> edges_;
};

}  // namespace

std::vector<PlateLine> contour(const PlatePicture& plate, double value) {
  Crossings crossings(plate, value);
  const std::vector<int>& t = plate.triangles;
  const auto known = [&](int node) { return std::isfinite(plate.values[node]); };
  for (std::size_t k = 0; k + 2 < t.size(); k += 3)
    if (known(t[k]) && known(t[k + 1]) && known(t[k + 2])) crossings.add(t[k], t[k + 1], t[k + 2]);
  return crossings.lines();
}

std::vector<int> bearing_triangles(const PlatePicture& plate) {
  std::vector<bool> bears(plate.deflection.size(), false);
  for (const int i : plate.bearing) bears[i] = true;
  std::vector<int> out;
  const std::vector<int>& t = plate.triangles;
  for (std::size_t k = 0; k + 2 < t.size(); k += 3)
    if (std::all_of(&t[k], &t[k] + 3, [&](int i) { return bears[i]; })) out.insert(out.end(), &t[k], &t[k] + 3);
  return out;
}

std::vector<PlateLine> hatch(const PlatePicture& plate, const std::vector<int>& triangles, double spacing) {
  std::vector<PlateLine> out;
  const auto height = [](const Vec3& p) { return (p[0] - p[1]) / std::numbers::sqrt2; };
  for (std::size_t k = 0; k + 2 < triangles.size(); k += 3) {
    const Vec3 corner[3] = {at(plate, triangles[k]), at(plate, triangles[k + 1]), at(plate, triangles[k + 2])};
    const auto [low, high] = std::minmax({height(corner[0]), height(corner[1]), height(corner[2])});
    for (double level = std::ceil(low / spacing); level * spacing < high; ++level) {
      PlateLine ends;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 &p = corner[c], &q = corner[(c + 1) % 3];
        const double a = height(p) - level * spacing, b = height(q) - level * spacing;
        if ((a > 0) != (b > 0)) ends.push_back(plus(p, plus(q, p, -1), a / (a - b)));
      }
      if (ends.size() == 2) out.push_back(std::move(ends));
    }
  }
  return out;
}

}  // namespace dotyk::figure
