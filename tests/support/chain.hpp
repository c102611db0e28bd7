#pragma once

#include "problem/problem.hpp"
#include "spring_grid.hpp"

namespace dotyk::test {

/// A block from a spring grid; `free`: its translations are its kernel.
inline problem::Block block(const std::string& name, const SpringGrid& grid, const algebra::Vector& f, int per_node,
                            bool free) {
  problem::Block b;
  b.name = name;
  b.K = grid.K;
  b.f = f;
  b.node = grid.node;
  const int n = static_cast<int>(grid.node.size());
  b.kernel = algebra::DenseMatrix::Zero(n, free ? per_node : 0);
  for (int u = 0; free && u < n; ++u) b.kernel(u, u % per_node) = 1;
  for (int i = 0; free && i < per_node; ++i) {
    std::vector<double> direction(per_node, 0.0);
    direction[i] = 1;
    b.motions.push_back({.direction = direction});
  }
  return b;
}

/// Rows of B from a dense matrix.
inline algebra::SparseRows rows(const algebra::DenseMatrix& B) { return B.sparseView(); }

/// A row group over rows first … first + count − 1.
inline problem::RowGroup group(std::shared_ptr<const problem::Law> law, int first, int count) {
  return {law->name() + " rows", law, first, count};
}

/// The stiffness of all blocks, dense.
inline algebra::DenseMatrix stiffness(const problem::Problem& p) {
  algebra::DenseMatrix K = algebra::DenseMatrix::Zero(p.unknowns(), p.unknowns());
  for (const auto& b : p.blocks) K.block(b.first, b.first, b.size(), b.size()) = full(b.K);
  return K;
}

}  // namespace dotyk::test
