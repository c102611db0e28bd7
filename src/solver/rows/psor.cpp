#include "solver/rows/psor.hpp"

#include "algebra/dense/decompositions.hpp"
#include "solver/rows/equilibrium.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::Problem;

Relaxation::Relaxation(const Problem& problem, const DenseMatrix& W) : W_(W) {
  const double noticed = W.size() ? 1e-14 * W.diagonal().maxCoeff() : 0;
  std::vector<std::vector<Site>> of_normal(problem.rows());
  for (const auto& [group, k, first, n] : problem.friction_points())
    (n < 0 ? sites_ : of_normal[n]).push_back({nullptr, &group, k, first, compliance(first, group.components)});
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    sites_.push_back({&law, nullptr, k, r, W(r, r)});
    sites_.insert(sites_.end(), of_normal[r].begin(), of_normal[r].end());
  }
  std::erase_if(sites_, [&](const Site& site) { return !(site.compliance > noticed); });
}

double Relaxation::compliance(int row, int count) const {
  if (count == 1) return W_(row, row);
  return algebra::eigenvalues(W_.block(row, row, count, count)).maxCoeff();
}

void Relaxation::sweep(double omega, Vector& lambda, Vector& x) const {
  const auto move = [&](int row, double to) {
    if (to == lambda[row]) return;
    x -= (to - lambda[row]) * W_.col(row);
    lambda[row] = to;
  };
  for (const Site& site : sites_) {
    const double rho = omega / site.compliance;
    const int first = site.row;
    if (site.law) {
      move(first, site.law->project(site.index, lambda[first] + rho * x[first], rho).lambda);
      continue;
    }
    const int d = site.friction->components;
    const double bound = site.friction->bound(site.index, lambda);
    Vector moved = lambda.segment(first, d) + rho * x.segment(first, d);
    const double length = moved.norm();
    if (length > bound) moved *= bound / length;
    for (int i = 0; i < d; ++i) move(first + i, moved[i]);
  }
}

void Psor::iterate(RowIteration& it) const {
  Equilibrium equilibrium(it);
  const Relaxation relaxation(it.problem, equilibrium.W());
  solver::iterate(it, equilibrium, [&](Vector lambda, Vector x) {
    relaxation.sweep(omega, lambda, x);
    return lambda;
  });
}

}  // namespace dotyk::solver
