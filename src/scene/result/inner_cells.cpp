#include "scene/result/inner_cells.hpp"

#include <algorithm>
#include <array>

#include "elasticity/interpolation.hpp"
#include "mesh/box_tree.hpp"
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
  const double share = factor / elasticity::cell_points(cells.mesh);
  elasticity::for_each_cell_point(cells.mesh, [&](const elasticity::CellPoint& p) {
    Point& sum = mean[static_cast<std::size_t>(p.cell)];
    sum = mesh::plus(sum, mesh::times(share, cells.force.at(p.cell, p.x)));
  });
  return mean;
}

}  // namespace

Lists estimate_cells(const multigrid::VisitedCells& at, const Lists& said) {
  const std::vector<double>& factor = said.real[0];
  std::vector<double> sums(kNumbers * factor.size(), 0.0);
  each_body(at, [&](const elasticity::ShareCells& cells, const std::vector<double>& u, std::size_t first) {
    const auto estimate = elasticity::estimate_error(cells.mesh, cells.material, u, mean_forces(cells, factor[static_cast<std::size_t>(cells.body)]), {});
    double* of_body = sums.data() + kNumbers * cells.body;
    for (int c = 0; c < cells.mesh.cell_count(); ++c) {
      if (!owns(at, first, cells.mesh, c)) continue;
      const elasticity::ErrorParts& parts = estimate.cells[static_cast<std::size_t>(c)];
      of_body[0] += parts.recovery, of_body[1] += parts.bulk, of_body[2] += parts.jump, of_body[3] += estimate.solution[static_cast<std::size_t>(c)];
    }
  });
  return {{}, {std::move(sums)}};
}

InnerEstimate inner_estimate(const Solution& solution) {
  std::vector<double> factor;
  for (const Body& body : solution.model().bodies) factor.push_back(body.volume_load ? body.volume_load->factor : 0);
  const auto told = visit_refined(solution.model(), solution.result().state.u, multigrid::VisitFor::estimate, estimate_cells, {{}, {factor}});
  InnerEstimate sum{{}, std::vector<double>(factor.size(), 0.0)};
  for (const Lists& of_rank : told)
    for (std::size_t b = 0; b < factor.size(); ++b) {
      const double* numbers = of_rank.real[0].data() + kNumbers * b;
      sum.parts.recovery += numbers[0], sum.parts.bulk += numbers[1], sum.parts.jump += numbers[2], sum.solution[b] += numbers[3];
    }
  return sum;
}

Lists values_at_point(const multigrid::VisitedCells& at, const Lists& said) {
  constexpr double kSlack = 1e-6;  // of a cell
  const Point x{said.real[0][0], said.real[0][1], said.real[0][2]};
  Lists told{{}, {{}}};
  each_body(at, [&](const elasticity::ShareCells& cells, const std::vector<double>& u, std::size_t first) {
    const mesh::Mesh& mesh = cells.mesh;
    if (cells.body != said.whole[0][0]) return;
    const mesh::BoxTree boxes = mesh::boxes_of_cells(mesh);
    std::array<double, mesh::kMostNodes> shape;
    for (const int c : boxes.around(x)) {
      if (!told.real[0].empty() || !owns(at, first, mesh, c) || !elasticity::shape_at(mesh, c, x, kSlack, shape)) continue;
      const std::vector<elasticity::Stress> stress = elasticity::nodal_stress(mesh, cells.material, u);
      InnerValues sum;
      for (int a = 0; a < mesh.topology().nodes; ++a) {
        const int node = mesh.cell(c)[a];
        sum.displacement = mesh::plus(sum.displacement, mesh::times(shape[a], mesh::at_node(u, node, mesh.dimension())));
        for (std::size_t v = 0; v < sum.stress.size(); ++v) sum.stress[v] += shape[a] * stress[node][v];
      }
      told.real[0].assign(sum.displacement.begin(), sum.displacement.end());
      told.real[0].insert(told.real[0].end(), sum.stress.begin(), sum.stress.end());
    }
  });
  return told;
}

std::optional<InnerValues> inner_values(const Solution& solution, int body, const Point& x) {
  const auto told = visit_refined(solution.model(), solution.result().state.u, multigrid::VisitFor::point, values_at_point, {{{body}}, {{x[0], x[1], x[2]}}});
  for (const Lists& of_rank : told) {
    const std::vector<double>& numbers = of_rank.real[0];
    if (numbers.empty()) continue;
    InnerValues values;
    std::copy_n(numbers.begin(), 3, values.displacement.begin()), std::copy_n(numbers.begin() + 3, 6, values.stress.begin());
    return values;
  }
  return std::nullopt;
}

}  // namespace dotyk::scene
