#pragma once

#include <numeric>

#include "programs.hpp"

namespace dotyk::test {

/// `nodes` of 1 + d unknowns, the first normal and the others tangential, each under unilateral contact
/// and friction; K positive definite with eigenvalues from `least` on, gaps that some nodes can close.
inline problem::Problem friction_program(Random& random, int nodes, int d, std::shared_ptr<const problem::Friction> law,
                                         double least = 1) {
  const int n = nodes * (1 + d);
  algebra::DenseMatrix B = algebra::DenseMatrix::Zero(n, n);  // normal rows first
  for (int k = 0; k < nodes; ++k) {
    B(k, k * (1 + d)) = 1;
    for (int i = 0; i < d; ++i) B(nodes + k * d + i, k * (1 + d) + 1 + i) = 1;
  }
  algebra::Vector c = algebra::Vector::Zero(n);
  c.head(nodes) = 0.1 * random.vector(nodes);
  auto p = program(random.positive_definite(n, least), 2 * random.vector(n), B, c);
  p.groups = {group(problem::unilateral(), 0, nodes)};
  std::vector<int> normal(nodes);
  std::iota(normal.begin(), normal.end(), 0);
  p.friction = {{"friction", std::move(law), nodes, d, std::move(normal)}};
  return p;
}

}  // namespace dotyk::test
