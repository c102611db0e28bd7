#include "mesh/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::mesh {
namespace {

Box box_of(const Mesh& mesh, int cell) {
  Box box;
  for (int k = 0; k < mesh.topology().nodes; ++k) box.add(mesh.point(mesh.cell(cell)[k]));
  // A curved side bulges beyond its nodes, by less than half its height.
  for (int i = 0; mesh.topology().order == 2 && i < 3; ++i) {
    const double margin = box.extent(i) / 4;
    box.low[i] -= margin, box.high[i] += margin;
  }
  return box;
}

}  // namespace

CellGrid::CellGrid(const Mesh& mesh) {
  const Box all = mesh.box();
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
  cells_ = Buckets(count_[0] * count_[1] * count_[2], [&](auto&& put) {
    for (int c = 0; c < mesh.cell_count(); ++c) bins(box_of(mesh, c), [&](int b) { put(b, c); });
  });
}

std::span<const int> CellGrid::near(const Point& x) const {
  int at[3];
  for (int i = 0; i < 3; ++i) {
    if (!(x[i] >= low_[i] && x[i] <= high_[i])) return {};
    at[i] = std::min(static_cast<int>((x[i] - low_[i]) / step_[i]), count_[i] - 1);
  }
  return cells_[(at[2] * count_[1] + at[1]) * count_[0] + at[0]];
}

}  // namespace dotyk::mesh
