#pragma once

#include "random.hpp"

namespace dotyk::test {

/// A stiffness of a grid of nodes joined by random positive definite springs between neighbours
/// (right and up), `per_node` unknowns a node, the first of which may have fewer.
struct SpringGrid {
  algebra::SparseMatrix K;  ///< lower triangle
  std::vector<int> node;    ///< of each unknown
  int nodes = 0;
};

/// `ground`: stiffness that ties every node to the ground (0: translations are free).
inline SpringGrid spring_grid(Random& random, int nx, int ny, int per_node, double ground, bool uneven = false) {
  SpringGrid grid;
  grid.nodes = nx * ny;
  std::vector<int> first;
  for (int n = 0; n < grid.nodes; ++n) {
    first.push_back(static_cast<int>(grid.node.size()));
    const int count = uneven && n % 3 == 0 ? per_node - 1 : per_node;
    for (int i = 0; i < count; ++i) grid.node.push_back(n);
  }
  first.push_back(static_cast<int>(grid.node.size()));
  algebra::DenseMatrix K = ground * algebra::DenseMatrix::Identity(grid.node.size(), grid.node.size());
  const auto join = [&](int a, int b) {
    const algebra::DenseMatrix k = random.positive_definite(per_node, 0.5);
    for (int i = 0; i < first[a + 1] - first[a]; ++i)
      for (int j = 0; j < first[a + 1] - first[a]; ++j) K(first[a] + i, first[a] + j) += k(i, j);
    for (int i = 0; i < first[b + 1] - first[b]; ++i)
      for (int j = 0; j < first[b + 1] - first[b]; ++j) K(first[b] + i, first[b] + j) += k(i, j);
    for (int i = 0; i < first[a + 1] - first[a]; ++i)
      for (int j = 0; j < first[b + 1] - first[b]; ++j) {
        K(first[a] + i, first[b] + j) -= k(i, j);
        K(first[b] + j, first[a] + i) -= k(i, j);
      }
  };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      if (x + 1 < nx) join(y * nx + x, y * nx + x + 1);
      if (y + 1 < ny) join(y * nx + x, (y + 1) * nx + x);
    }
  grid.K = lower(K);
  return grid;
}

}  // namespace dotyk::test
