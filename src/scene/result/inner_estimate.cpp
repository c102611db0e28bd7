#include "scene/result/inner_estimate.hpp"

#include "elasticity/share.hpp"
#include "scene/model/slices.hpp"

namespace dotyk::scene {

namespace {

using mesh::Point;

constexpr int kNumbers = 4;  // of a body: recovery, bulk, jump, the solution's norm

/// The mean of each cell's points, as the load has it.
std::vector<Point> mean_forces(const elasticity::ShareCells& cells, double factor) {
  std::vector<Point> mean;
  if (!cells.force.any()) return mean;
  mean.assign(static_cast<std::size_t>(cells.mesh.cell_count()), Point{0, 0, 0});
  std::vector<double> nodal(cells.mesh.coordinates.size(), 0.0);
  const double share = factor / elasticity::cell_points(cells.mesh);
  elasticity::add_body_force(cells.mesh, [&](const elasticity::CellPoint& p) {
    const Point f = cells.force.at(p.cell, p.x);
    for (int i = 0; i < 3; ++i) mean[static_cast<std::size_t>(p.cell)][i] += share * f[i];
    return f;
  }, nodal);
  return mean;
}

}  // namespace

Lists estimate_cells(const multigrid::VisitedCells& at, const Lists& said) {
  const std::vector<double>& factor = said.real[0];
  std::vector<double> sums(kNumbers * factor.size(), 0.0);
  std::size_t first = 0;
  for (const elasticity::ShareCells& cells : static_cast<const elasticity::RefinableShare&>(at.cells).bodies()) {
    const auto d = static_cast<std::size_t>(cells.mesh.dimension()), begin = first * d;
    const std::vector<double> u(at.u.begin() + static_cast<std::ptrdiff_t>(begin), at.u.begin() + static_cast<std::ptrdiff_t>(begin + cells.mesh.coordinates.size()));
    const auto estimate = elasticity::estimate_error(cells.mesh, cells.material, u, mean_forces(cells, factor[static_cast<std::size_t>(cells.body)]), {});
    double* of_body = sums.data() + kNumbers * cells.body;
    for (int c = 0; c < cells.mesh.cell_count(); ++c) {
      if (!owns(at, first, cells.mesh, c)) continue;
      const elasticity::ErrorParts& parts = estimate.cells[static_cast<std::size_t>(c)];
      of_body[0] += parts.recovery, of_body[1] += parts.bulk, of_body[2] += parts.jump, of_body[3] += estimate.solution[static_cast<std::size_t>(c)];
    }
    first += static_cast<std::size_t>(cells.mesh.node_count());
  }
  return {{}, {std::move(sums)}};
}

InnerEstimate inner_estimate(const Solution& solution) {
  std::vector<double> factor;
  for (const Body& body : solution.model().bodies) factor.push_back(body.volume_load ? body.volume_load->factor : 0);
  const auto told = visit_refined(solution.model(), solution.result().state.u, multigrid::VisitFor::estimate,
                                  [](multigrid::VisitFor, const multigrid::VisitedCells& at, const Lists& said) { return estimate_cells(at, said); }, {{}, {factor}});
  InnerEstimate sum{{}, std::vector<double>(factor.size(), 0.0)};
  for (const Lists& of_rank : told)
    for (std::size_t b = 0; b < factor.size(); ++b) {
      const double* numbers = of_rank.real[0].data() + kNumbers * b;
      sum.parts.recovery += numbers[0], sum.parts.bulk += numbers[1], sum.parts.jump += numbers[2], sum.solution[b] += numbers[3];
    }
  return sum;
}

}  // namespace dotyk::scene
