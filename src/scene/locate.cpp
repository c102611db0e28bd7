#include "scene/locate.hpp"

#include <algorithm>
#include <cmath>

#include "elasticity/interpolation.hpp"

namespace dotyk::scene {

using mesh::Mesh;
using mesh::Point;

namespace {

struct Box {
  Point low, high;
};

Box box_of(const Mesh& mesh, int cell) {
  Box b{mesh.point(mesh.cell(cell)[0]), mesh.point(mesh.cell(cell)[0])};
  for (int k = 1; k < mesh.topology().nodes; ++k) {
    const Point p = mesh.point(mesh.cell(cell)[k]);
    for (int i = 0; i < 3; ++i) {
      b.low[i] = std::min(b.low[i], p[i]);
      b.high[i] = std::max(b.high[i], p[i]);
    }
  }
  return b;
}

}  // namespace

Locator::Locator(const Mesh& mesh) : mesh_(mesh) {
  low_ = high_ = mesh.point(0);
  for (int n = 1; n < mesh.node_count(); ++n) {
    const Point p = mesh.point(n);
    for (int i = 0; i < 3; ++i) {
      low_[i] = std::min(low_[i], p[i]);
      high_[i] = std::max(high_[i], p[i]);
    }
  }
  const int per_axis = std::max(1, static_cast<int>(std::pow(mesh.cell_count(), 1.0 / mesh.dimension())));
  const double margin = 1e-6 * mesh.size();
  for (int i = 0; i < 3; ++i) {
    low_[i] -= margin;
    high_[i] += margin;
    if (i < mesh.dimension()) count_[i] = per_axis;
    step_[i] = (high_[i] - low_[i]) / count_[i];
  }
  const auto bins = [&](const Box& b, auto&& visit) {
    int from[3], to[3];
    for (int i = 0; i < 3; ++i) {
      from[i] = std::clamp(static_cast<int>((b.low[i] - margin - low_[i]) / step_[i]), 0, count_[i] - 1);
      to[i] = std::clamp(static_cast<int>((b.high[i] + margin - low_[i]) / step_[i]), 0, count_[i] - 1);
    }
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) visit((z * count_[1] + y) * count_[0] + x);
  };
  start_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
  for (int c = 0; c < mesh.cell_count(); ++c) bins(box_of(mesh, c), [&](int b) { ++start_[b + 1]; });
  for (std::size_t b = 0; b + 1 < start_.size(); ++b) start_[b + 1] += start_[b];
  cells_.resize(start_.back());
  std::vector<int> fill(start_.begin(), start_.end() - 1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    bins(box_of(mesh, c), [&](int b) { cells_[fill[b]++] = c; });
}

std::optional<Place> Locator::find(const Point& x) const {
  int at[3];
  for (int i = 0; i < 3; ++i) {
    if (!(x[i] >= low_[i] && x[i] <= high_[i])) return std::nullopt;
    at[i] = std::min(static_cast<int>((x[i] - low_[i]) / step_[i]), count_[i] - 1);
  }
  const int bin = (at[2] * count_[1] + at[1]) * count_[0] + at[0];
  for (int k = start_[bin]; k < start_[bin + 1]; ++k) {
    Place place{cells_[k], {}};
    if (elasticity::shape_at(mesh_, place.cell, x, 1e-6, place.shape)) return place;
  }
  return std::nullopt;
}

}  // namespace dotyk::scene
