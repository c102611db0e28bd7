#pragma once

#include <numeric>
#include <optional>

#include "algebra/dense/decompositions.hpp"
#include "chain.hpp"
#include "solver/active/pdas.hpp"

namespace dotyk::test {

/// minimise ½uᵀKu − fᵀu subject to Bu ≤ c, one block, every unknown its own node.
inline problem::Problem program(const algebra::DenseMatrix& K, const algebra::Vector& f, const algebra::DenseMatrix& B,
                                const algebra::Vector& c) {
  problem::Problem p;
  problem::Block b;
  b.name = "program";
  b.K = lower(K);
  b.f = f;
  b.node.resize(f.size());
  std::iota(b.node.begin(), b.node.end(), 0);
  b.kernel.resize(f.size(), 0);
  problem::add(p, b);
  p.B = rows(B);
  p.c = c;
  p.groups.push_back(group(problem::unilateral(), 0, static_cast<int>(c.size())));
  return p;
}

/// The optimal state by trying every active set of the unilateral rows; bilateral and elastic
/// rows (`compliance` 0 or 1/k) are always in. Empty where no set is optimal to `slack`.
inline std::optional<problem::State> by_enumeration(const problem::Problem& p,
                                                    const std::vector<double>& compliance = {}) {
  const algebra::DenseMatrix K = stiffness(p), B = p.B;
  const algebra::Vector f = p.load();
  const int n = p.unknowns(), m = p.rows();
  const auto groups = p.group_of_rows();
  std::vector<int> unilateral;
  for (int r = 0; r < m; ++r)
    if (groups[r]->law->unilateral()) unilateral.push_back(r);
  for (unsigned set = 0; set < (1u << unilateral.size()); ++set) {
    std::vector<char> in(m, 1);
    for (std::size_t k = 0; k < unilateral.size(); ++k) in[unilateral[k]] = set >> k & 1;
    algebra::DenseMatrix A = algebra::DenseMatrix::Zero(n + m, n + m);
    algebra::Vector b = algebra::Vector::Zero(n + m);
    A.topLeftCorner(n, n) = K;
    b.head(n) = f;
    for (int r = 0; r < m; ++r) {
      A.block(0, n + r, n, 1) = B.row(r).transpose();
      if (in[r]) {
        A.block(n + r, 0, 1, n) = B.row(r);
        if (!compliance.empty()) A(n + r, n + r) = -compliance[r];
        b[n + r] = p.c[r];
      } else {
        A(n + r, n + r) = 1;
      }
    }
    const algebra::PivotedLu lu(A);
    if (!lu.regular()) continue;
    const algebra::Vector y = lu.solve(b), x = B * y.head(n) - p.c, lambda = y.tail(m);
    const double force = 1e-9 * (f.norm() + lambda.norm());
    const double length = 1e-9 * (y.head(n).norm() + p.c.norm() + f.norm() / K.norm());
    bool optimal = true;
    for (int r : unilateral) optimal = optimal && x[r] <= length && lambda[r] >= -force;
    if (optimal) return problem::State{y.head(n), lambda};
  }
  return std::nullopt;
}

/// Settings of one of the two forms of PDAS.
inline solver::Pdas pdas(bool reduced, std::vector<char> start = {}) {
  solver::Pdas settings;
  settings.reduced = reduced;
  settings.start = std::move(start);
  return settings;
}

}  // namespace dotyk::test
