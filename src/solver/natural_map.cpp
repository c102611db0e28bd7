#include "solver/natural_map.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

NaturalMap::NaturalMap(const Problem& problem, const problem::CondensedProblem& condensed, const Vector& rho)
    : problem_(problem), condensed_(condensed), rho_(rho) {
  for (const FrictionGroup& group : problem.friction)  // the projection onto a disc needs one ρ
    for (int k = 0; k < group.points(); ++k)
      rho_.segment(group.row(k), group.components).setConstant(rho[group.normal[k]]);
}

int NaturalMap::Value::differences(const Value& other) const {
  int count = 0;
  for (std::size_t r = 0; r < piece.size(); ++r) count += piece[r] != other.piece[r];
  return count;
}

NaturalMap::Value NaturalMap::at(const Vector& lambda, const Vector& alpha) const {
  const int m = problem_.rows();
  Value v;
  v.projected = Vector::Zero(m);
  v.x = condensed_.jump(lambda, alpha);
  v.y = lambda + rho_.cwiseProduct(v.x);
  v.closed.assign(m, 0);
  v.slipping.assign(m, 0);
  v.piece.assign(m, 0);
  Vector slope = Vector::Zero(m);
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const problem::Projection p = group.law->project(r - group.first, v.y[r], rho_[r]);
      v.projected[r] = p.lambda;
      slope[r] = p.slope;
      if (p.slope == 0) continue;
      v.slope.emplace_back(r, r, p.slope);
      v.closed[r] = v.piece[r] = 1;
      ++v.active;
    }
  for (const FrictionGroup& group : problem_.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int first = group.row(k), n = group.normal[k], d = group.components;
      const double bound = group.law->bound(k, v.projected[n]);
      if (bound == 0) continue;  // open, or without friction here
      const problem::DiscProjection p = problem::project_disc(v.y.segment(first, d), bound);
      v.projected.segment(first, d) = p.value;
      for (int i = 0; i < d; ++i) {
        for (int j = 0; j < d; ++j)
          if (p.slope(i, j) != 0) v.slope.emplace_back(first + i, first + j, p.slope(i, j));
        const double by_normal = p.by_bound[i] * group.law->bound_slope(k) * slope[n];
        if (by_normal != 0) v.slope.emplace_back(first + i, n, by_normal);
        v.piece[first + i] = p.stick ? 1 : 2;
        v.slipping[first + i] = !p.stick;
      }
      ++(p.stick ? v.stick : v.slip);
    }
  const Vector unbalanced = condensed_.e() - condensed_.N().transpose() * lambda;
  v.norm = std::sqrt((lambda - v.projected).squaredNorm() + unbalanced.squaredNorm());
  return v;
}

NaturalMap::Value NaturalMap::sticking(const std::vector<char>& start) const {
  const int m = problem_.rows();
  Value v = at(Vector::Zero(m), Vector::Zero(condensed_.kernel_size()));
  const double touching = 1e-12 * (m ? problem_.c.lpNorm<Eigen::Infinity>() : 0);
  std::vector<char> closed(m, 0);
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      closed[r] = group.law->unilateral() ? (start.empty() ? problem_.c[r] <= touching : start[r]) : 1;
  for (const FrictionGroup& group : problem_.friction)
    for (int k = 0; k < group.points(); ++k)
      for (int i = 0; i < group.components; ++i) closed[group.row(k) + i] = closed[group.normal[k]];
  std::vector<char> scalar(m, 0);
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) scalar[r] = !group.law->unilateral();
  std::erase_if(v.slope, [&](const auto& t) { return !scalar[t.row()]; });
  for (int r = 0; r < m; ++r) {
    if (scalar[r]) continue;
    v.projected[r] = v.y[r] = 0;  // x' = 0 where closed, λ' = 0 elsewhere
    if (closed[r]) v.slope.emplace_back(r, r, 1.0);
  }
  return v;
}

NaturalMap::System NaturalMap::linearise(const Value& v) const {
  // λ' = projected + S (λ' + ρ x' − y) with x' = x₀ − W λ' + N α'.
  const int m = problem_.rows();
  Eigen::SparseMatrix<double, Eigen::RowMajor> S(m, m);
  S.setFromTriplets(v.slope.begin(), v.slope.end());
  System system;
  std::vector<int> place(m, -1);
  for (int r = 0; r < m; ++r)
    if (S.outerIndexPtr()[r + 1] > S.outerIndexPtr()[r]) {
      place[r] = static_cast<int>(system.rows.size());
      system.rows.push_back(r);
    }
  system.fixed = v.projected;
  for (int r : system.rows) system.fixed[r] = 0;
  const Vector rest = condensed_.jump(system.fixed, Vector());
  const Eigen::Index n = static_cast<Eigen::Index>(system.rows.size()), k = condensed_.kernel_size();
  system.matrix = DenseMatrix::Zero(n + k, n + k);
  system.right_side = Vector::Zero(n + k);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int r = system.rows[i];
    system.matrix(i, i) += 1;
    double& b = system.right_side[i];
    b = v.projected[r];
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(S, r); it; ++it) {
      const int c = static_cast<int>(it.col());
      const double s = it.value();
      if (place[c] >= 0)
        system.matrix(i, place[c]) -= s;
      else
        b += s * system.fixed[c];
      b += s * (rho_[c] * rest[c] - v.y[c]);
      for (Eigen::Index j = 0; j < n; ++j) system.matrix(i, j) += s * rho_[c] * condensed_.W()(c, system.rows[j]);
      for (Eigen::Index j = 0; j < k; ++j) system.matrix(i, n + j) -= s * rho_[c] * condensed_.N()(c, j);
    }
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) system.matrix(n + j, i) = condensed_.N()(system.rows[i], j);
    system.right_side[n + j] = condensed_.e()[j] - condensed_.N().col(j).dot(system.fixed);
  }
  return system;
}

void NaturalMap::take(const System& system, const Vector& solved, Vector& lambda, Vector& alpha) const {
  lambda = system.fixed;
  for (std::size_t i = 0; i < system.rows.size(); ++i) lambda[system.rows[i]] = solved[static_cast<Eigen::Index>(i)];
  alpha = solved.tail(condensed_.kernel_size());
}

}  // namespace dotyk::solver
