#include "mesh/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::mesh {
namespace {

struct Box {
  Point low, high;
};

void extend(Box& box, const Point& p) {
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], p[i]);
    box.high[i] = std::max(box.high[i], p[i]);
  }
}

Box box_of(const Mesh& mesh, int cell) {
  Box box{mesh.point(mesh.cell(cell)[0]), mesh.point(mesh.cell(cell)[0])};
  for (int k = 1; k < mesh.topology().nodes; ++k) extend(box, mesh.point(mesh.cell(cell)[k]));
  // A curved side bulges beyond its nodes, by less than half its height.
  for (int i = 0; mesh.topology().order == 2 && i < 3; ++i) {
    const double margin = (box.high[i] - box.low[i]) / 4;
    box.low[i] -= margin, box.high[i] += margin;
  }
  return box;
}

}  // namespace

CellGrid::CellGrid(const Mesh& mesh) {
  Box all{mesh.point(0), mesh.point(0)};
  for (int n = 1; n < mesh.node_count(); ++n) extend(all, mesh.point(n));
  low_ = all.low, high_ = all.high;
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
  for (int c = 0; c < mesh.cell_count(); ++c) bins(box_of(mesh, c), [&](int b) { cells_[fill[b]++] = c; });
}

std::span<const int> CellGrid::near(const Point& x) const {
  int at[3];
  for (int i = 0; i < 3; ++i) {
    if (!(x[i] >= low_[i] && x[i] <= high_[i])) return {};
    at[i] = std::min(static_cast<int>((x[i] - low_[i]) / step_[i]), count_[i] - 1);
  }
  const int bin = (at[2] * count_[1] + at[1]) * count_[0] + at[0];
  return std::span(cells_).subspan(start_[bin], start_[bin + 1] - start_[bin]);
}

}  // namespace dotyk::mesh
