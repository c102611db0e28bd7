#include "figure/compose/compose_grid.hpp"
#include "plate/solution.hpp"

namespace dotyk::figure {

GridFile compose_grid(const plate::Solution& s, const std::string& file) {
  const mesh::Mesh& mesh = *s.plate().mesh;
  GridFile grid{file, {}, {{"plate", CellShape::triangle, mesh.cells}}, {}};
  GridArray displacement{"displacement", {"x", "y", "z"}, {}}, moment{"moment", {"xx", "yy", "xy"}, {}};
  for (int n = 0; n < mesh.node_count(); ++n) {
    const mesh::Point x = mesh.point(n);
    grid.points.insert(grid.points.end(), x.begin(), x.end());
    displacement.values.insert(displacement.values.end(), {0, 0, s.vertex_deflection(n)});
    const plate::Moment& m = s.vertex_moments()[n];
    moment.values.insert(moment.values.end(), {m.xx, m.yy, m.xy});
  }
  grid.arrays = {std::move(displacement), std::move(moment)};
  if (s.model().obstacle_row.empty()) return grid;
  GridArray force{"obstacle_force", {""}, std::vector<double>(mesh.node_count(), 0.0)};
  for (int n = 0; n < mesh.node_count(); ++n)
    if (s.model().obstacle_row[n] >= 0) force.values[n] = s.result().state.lambda[s.model().obstacle_row[n]];
  grid.arrays.push_back(std::move(force));
  return grid;
}

}  // namespace dotyk::figure
