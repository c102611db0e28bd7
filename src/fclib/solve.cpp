#include "fclib/solve.hpp"

namespace dotyk::fclib {

using algebra::DenseMatrix;
using algebra::Vector;

Rows rows_of(const ContactProblem& p) {
  const int d = p.dimension, contacts = p.contacts(), m = p.rows();
  std::vector<int> place(m);
  for (int k = 0; k < contacts; ++k)
    for (int i = 0; i < d; ++i) place[k * d + i] = i == 0 ? k : contacts + k * (d - 1) + i - 1;
  DenseMatrix W(m, m);
  Vector x0(m);
  for (int j = 0; j < m; ++j) {
    x0[place[j]] = -p.q[j];
    for (int i = 0; i < m; ++i) W(place[i], place[j]) = p.W(i, j);
  }
  problem::Problem rows;
  rows.B = algebra::SparseRows(m, 0);
  rows.c = Vector::Zero(m);
  rows.groups.push_back({p.name, problem::unilateral(), 0, contacts});
  problem::FrictionGroup friction{p.name, problem::coulomb({p.mu.begin(), p.mu.end()}), contacts, d - 1, {}};
  for (int k = 0; k < contacts; ++k) friction.normal.push_back(k);
  rows.friction.push_back(std::move(friction));
  return {std::move(rows), problem::CondensedProblem(std::move(W), std::move(x0)), std::move(place)};
}

Result solve(const ContactProblem& p, const solver::Method& method, Monitor& monitor) {
  const Rows rows = rows_of(p);
  Result result;
  result.iteration = method.run(rows.problem, rows.condensed, monitor);
  result.r.resize(p.rows());
  for (int i = 0; i < p.rows(); ++i) result.r[i] = result.iteration.state.lambda[rows.place[i]];
  result.measure = measure(p, result.r);
  return result;
}

}  // namespace dotyk::fclib
