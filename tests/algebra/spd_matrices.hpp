#pragma once

#include <algorithm>
#include <vector>

#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"

namespace dotyk::test {

/// Dense A_CC − A_CI A_II⁻¹ A_IC.
inline algebra::DenseMatrix schur(const algebra::DenseMatrix& A, const std::vector<int>& c) {
  std::vector<int> i;
  for (int k = 0; k < A.rows(); ++k)
    if (std::find(c.begin(), c.end(), k) == c.end()) i.push_back(k);
  if (i.empty()) return A(c, c);
  return A(c, c) - A(c, i) * algebra::Ldlt(algebra::DenseMatrix(A(i, i))).solve(algebra::DenseMatrix(A(i, c)));
}

/// The 7-point Laplacian on a grid of nx × ny × nz inner nodes, zero around it; `stretch` weighs the coupling along x.
/// Lower triangle. Eigenvalues: Σ 2 w (1 − cos(kπ/(n + 1))) over the three directions, w = stretch, 1, 1.
inline algebra::SparseMatrix laplacian(int nx, int ny, int nz, double stretch = 1) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const int i = (z * ny + y) * nx + x;
        entries.emplace_back(i, i, 4 + 2 * stretch);
        if (x + 1 < nx) entries.emplace_back(i + 1, i, -stretch);
        if (y + 1 < ny) entries.emplace_back(i + nx, i, -1);
        if (z + 1 < nz) entries.emplace_back(i + nx * ny, i, -1);
      }
  algebra::SparseMatrix K(nx * ny * nz, nx * ny * nz);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/// A laplacian plus a random symmetric positive definite coupling of rank one in each of some small groups of unknowns:
/// entries of both signs, no M-matrix, as in elasticity.
inline algebra::SparseMatrix coupled(int n, Random& random) {
  algebra::SparseMatrix K = laplacian(n, n, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (int group = 0; group < n * n * n; ++group) {
    int member[4];
    double weight[4];
    for (int a = 0; a < 4; ++a) member[a] = random.below(n * n * n), weight[a] = random.between(-2, 2);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (member[a] >= member[b]) entries.emplace_back(member[a], member[b], weight[a] * weight[b]);
  }
  algebra::SparseMatrix more(K.rows(), K.cols());
  more.setFromTriplets(entries.begin(), entries.end());
  return K + more;
}

inline std::vector<int> each_its_own(Eigen::Index n) {
  std::vector<int> node(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < node.size(); ++i) node[i] = static_cast<int>(i);
  return node;
}

}  // namespace dotyk::test
