#include "solver/rows/relaxation.hpp"

#include "algebra/dense/decompositions.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

Relaxation::Relaxation(const Problem& problem, const DenseMatrix& W) : W_(W) {
  const double noticed = W.size() ? 1e-14 * W.diagonal().maxCoeff() : 0;
  std::vector<std::vector<Site>> of_normal(problem.rows());
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      auto& place = group.normal[k] < 0 ? sites_ : of_normal[group.normal[k]];
      place.push_back({nullptr, &group, k, compliance(group.row(k), group.components)});
    }
  for (const RowGroup& group : problem.groups)
    for (int k = 0; k < group.count; ++k) {
      sites_.push_back({&group, nullptr, k, W(group.first + k, group.first + k)});
      for (const Site& site : of_normal[group.first + k]) sites_.push_back(site);
    }
  std::erase_if(sites_, [&](const Site& site) { return !(site.compliance > noticed); });
}

double Relaxation::compliance(int row, int count) const {
  if (count == 1) return W_(row, row);
  return algebra::eigenvalues(W_.block(row, row, count, count)).maxCoeff();
}

void Relaxation::sweep(double omega, Vector& lambda, Vector& x) const {
  for (const Site& site : sites_) {
    const double rho = omega / site.compliance;
    if (site.rows) {
      const int r = site.rows->first + site.index;
      const double moved = site.rows->law->project(site.index, lambda[r] + rho * x[r], rho).lambda;
      if (moved == lambda[r]) continue;
      x -= (moved - lambda[r]) * W_.col(r);
      lambda[r] = moved;
      continue;
    }
    const int first = site.friction->row(site.index), d = site.friction->components;
    const double bound = site.friction->bound(site.index, lambda);
    Vector moved = lambda.segment(first, d) + rho * x.segment(first, d);
    const double length = moved.norm();
    if (length > bound) moved *= bound / length;
    for (int i = 0; i < d; ++i) {
      if (moved[i] == lambda[first + i]) continue;
      x -= (moved[i] - lambda[first + i]) * W_.col(first + i);
      lambda[first + i] = moved[i];
    }
  }
}

}  // namespace dotyk::solver
