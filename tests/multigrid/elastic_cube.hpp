#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "algebra/coarse_functions.hpp"

namespace dotyk::test {

/// Lower triangle, node of each unknown, rigid motions: what a solver is made from.
struct ElasticCube {
  algebra::SparseMatrix lower;
  std::vector<int> node;
  algebra::DenseMatrix motions;
  std::vector<std::array<double, 3>> point;  ///< of each unknown
  std::vector<int> component;                ///< of each unknown
};

namespace detail {

using Gradients = std::array<std::array<double, 3>, 4>;

/// Of the four hat functions on the tetrahedron whose edges follow the axes in this order, `h` long: from each vertex to the next.
inline Gradients gradients(const std::array<int, 3>& axes, double h) {
  Gradients g{};
  for (int s = 0; s < 3; ++s) g[s][axes[s]] -= 1 / h, g[s + 1][axes[s]] += 1 / h;
  return g;
}

inline double stiffness(const Gradients& g, int a, int i, int b, int j) {
  constexpr double E = 1000, nu = 0.3, mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  const double dot = g[a][0] * g[b][0] + g[a][1] * g[b][1] + g[a][2] * g[b][2];
  return lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] + (i == j ? mu * dot : 0);
}

}  // namespace detail

/// The unit cube of n³ cells, each cut into six tetrahedra (Kuhn), P1. `fixed` says of a point and a component whether it is no unknown.
inline ElasticCube elastic_cube(int n, const std::function<bool(const std::array<double, 3>&, int)>& fixed) {
  ElasticCube cube;
  const double h = 1.0 / n;
  const auto at = [&](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  std::vector<std::array<int, 3>> unknown(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)));
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x)
        for (int c = 0; c < 3; ++c) {
          const std::array<double, 3> p = {x * h, y * h, z * h};
          unknown[at(x, y, z)][c] = fixed(p, c) ? -1 : static_cast<int>(cube.node.size());
          if (fixed(p, c)) continue;
          cube.node.push_back(at(x, y, z));
          cube.point.push_back(p);
          cube.component.push_back(c);
        }
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::array<int, 3>& axes : {std::array{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
    const detail::Gradients g = detail::gradients(axes, h);
    for (int cell = 0; cell < n * n * n; ++cell) {
      std::array<int, 3> corner = {cell % n, cell / n % n, cell / (n * n)};
      std::array<int, 12> u{};
      for (int v = 0; v < 4; ++v) {
        if (v > 0) ++corner[axes[v - 1]];
        for (int c = 0; c < 3; ++c) u[3 * v + c] = unknown[at(corner[0], corner[1], corner[2])][c];
      }
      for (int r = 0; r < 12; ++r)
        for (int s = 0; s < 12; ++s)
          if (u[s] >= 0 && u[r] >= u[s]) entries.emplace_back(u[r], u[s], h * h * h / 6 * detail::stiffness(g, r / 3, r % 3, s / 3, s % 3));
    }
  }
  const auto size = static_cast<Eigen::Index>(cube.node.size());
  cube.lower.resize(size, size);
  cube.lower.setFromTriplets(entries.begin(), entries.end());
  cube.motions = algebra::DenseMatrix::Zero(size, 6);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto& p = cube.point[i];
    const int c = cube.component[i];
    cube.motions(i, c) = 1;
    cube.motions(i, 3 + (c + 1) % 3) = p[(c + 2) % 3];   // rotation about the axis after c, of a point on the axis after that
    cube.motions(i, 3 + (c + 2) % 3) = -p[(c + 1) % 3];
  }
  return cube;
}

inline ElasticCube cube_on_its_bottom(int n) {
  return elastic_cube(n, [](const std::array<double, 3>& p, int) { return p[2] == 0; });
}

/// The unknowns of a cube of n³ cells on its bottom by the displacements of one of (n/2)³ cells: a node that this has not is in the middle of one of its edges.
inline algebra::CoarseFunctions functions_of_coarser(const ElasticCube& cube, int n) {
  const int full = n + 1, half = n / 2 + 1;
  std::vector<int> row(static_cast<std::size_t>(3 * full * full * full), -1), column(static_cast<std::size_t>(3 * half * half * half));
  for (std::size_t i = 0; i < cube.node.size(); ++i) row[3 * cube.node[i] + cube.component[i]] = static_cast<int>(i);
  for (int j = 0; j < static_cast<int>(column.size()); ++j) column[j] = j < 3 * half * half ? -1 : j;  // none of the bottom
  const auto columns = static_cast<int>(column.size());
  const auto means = std::make_shared<const Buckets>(full * full * full, [&](auto&& put) {
    for (int i = 0; i < full * full * full; ++i) {
      const int x = i % full, y = i / full % full, z = i / (full * full);
      const int low = (z / 2 * half + y / 2) * half + x / 2, high = ((z + 1) / 2 * half + (y + 1) / 2) * half + (x + 1) / 2;
      put(i, low);
      if (high != low) put(i, high);
    }
  });
  return {3, means, std::move(row), std::move(column), static_cast<int>(cube.node.size()), columns};
}

inline algebra::SparseRows as_matrix(const algebra::CoarseFunctions& functions) {
  algebra::SparseRows P;
  functions.to_matrix(P);
  return P;
}

/// z of the nodes of the top within `radius` of its middle.
inline std::vector<char> disc_on_top(const ElasticCube& cube, double radius) {
  std::vector<char> held(cube.node.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto& p = cube.point[i];
    held[i] = cube.component[i] == 2 && p[2] > 1 - 1e-9 && std::hypot(p[0] - 0.5, p[1] - 0.5) < radius;
  }
  return held;
}

/// The matrix in the same pattern, rows and columns of held unknowns empty but for their diagonal.
inline algebra::SparseMatrix holding(const algebra::SparseMatrix& lower, const std::vector<char>& held) {
  algebra::SparseMatrix out = lower;
  for (int j = 0; j < out.outerSize(); ++j)
    for (algebra::SparseMatrix::InnerIterator it(out, j); it; ++it)
      if (it.row() != j && (held[it.row()] || held[j])) it.valueRef() = 0;
  return out;
}

/// All entries, for a solver's set().
inline algebra::Triplets entries(const algebra::SparseMatrix& lower) {
  algebra::Triplets all;
  for (int j = 0; j < lower.outerSize(); ++j)
    for (algebra::SparseMatrix::InnerIterator it(lower, j); it; ++it) all.emplace_back(static_cast<int>(it.row()), j, it.value());
  return all;
}

inline algebra::Vector pressure_on_top(const ElasticCube& cube, const std::vector<char>& held) {
  algebra::Vector b = algebra::Vector::Zero(static_cast<Eigen::Index>(cube.node.size()));
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i] && cube.component[i] == 2 && cube.point[i][2] > 1 - 1e-9) b[static_cast<Eigen::Index>(i)] = -1;
  return b;
}

}  // namespace dotyk::test
