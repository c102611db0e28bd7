#include "elasticity/h1_norm.hpp"

#include <vector>

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

/// k[a][b] = ∫ ∇φ_a·∇φ_b + φ_a φ_b/ℓ² over a cell.
template <class E>
void cell_gram(const double x[][E::dim], double length, double k[][E::nodes]) {
  for (int a = 0; a < E::nodes; ++a)
    for (int b = 0; b < E::nodes; ++b) k[a][b] = 0;
  double g[E::nodes][E::dim];
  for (int q = 0; q < E::load_points; ++q) {
    const auto at = E::load_point(q);
    const double w = physical_gradient<E>(x, at, g) * E::load_weight(q);
    const auto shape = E::shape(at);
    for (int a = 0; a < E::nodes; ++a)
      for (int b = 0; b < E::nodes; ++b) {
        double sum = shape[a] * shape[b] / (length * length);
        for (int i = 0; i < E::dim; ++i) sum += g[a][i] * g[b][i];
        k[a][b] += w * sum;
      }
  }
}

}  // namespace

algebra::SparseMatrix h1_gram(const mesh::Mesh& mesh, const Numbering& numbering, double length) {
  std::vector<Eigen::Triplet<double>> entries;
  const int dim = mesh.dimension();
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], k[E::nodes][E::nodes];
    for (int c = 0; c < mesh.cell_count(); ++c) {
      cell_coordinates<E>(mesh, c, x);
      cell_gram<E>(x, length, k);
      for (int a = 0; a < E::nodes; ++a)
        for (int b = 0; b < E::nodes; ++b)
          for (int i = 0; i < dim; ++i) {
            const int row = numbering.unknown[static_cast<std::size_t>(mesh.cell(c)[a]) * dim + i];
            const int column = numbering.unknown[static_cast<std::size_t>(mesh.cell(c)[b]) * dim + i];
            if (row >= column && column >= 0) entries.emplace_back(row, column, k[a][b]);
          }
    }
  });
  algebra::SparseMatrix gram(numbering.count(), numbering.count());
  gram.setFromTriplets(entries.begin(), entries.end());
  return gram;
}

}  // namespace dotyk::elasticity
