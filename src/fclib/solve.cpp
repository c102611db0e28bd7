#include "fclib/solve.hpp"

#include <algorithm>

namespace dotyk::fclib {

using algebra::Vector;

Eigen::VectorXd project_cone(const Eigen::Ref<const Eigen::VectorXd>& y, double mu) {
  const double normal = y[0], tangential = y.tail(y.size() - 1).norm();
  if (tangential <= mu * normal) return y;
  if (mu * tangential <= -normal) return Eigen::VectorXd::Zero(y.size());
  Eigen::VectorXd p(y.size());
  p[0] = (normal + mu * tangential) / (1 + mu * mu);
  if (tangential > 0)
    p.tail(y.size() - 1) = mu * p[0] / tangential * y.tail(y.size() - 1);
  else
    p.tail(y.size() - 1).setZero();
  return p;
}

Measure measure(const ContactProblem& problem, const Vector& r) {
  const int d = problem.dimension;
  Measure m;
  m.u = problem.W * r + problem.q;
  const double compliance = problem.rows() ? problem.W.diagonal().maxCoeff() : 0;
  const double rho = compliance > 0 ? 1 / compliance : 1;
  double square = 0;
  for (int k = 0; k < problem.contacts(); ++k) {
    const double mu = problem.mu[k];
    Eigen::VectorXd y = r.segment(k * d, d) - rho * m.u.segment(k * d, d);
    y[0] -= rho * mu * m.u.segment(k * d + 1, d - 1).norm();
    square += (r.segment(k * d, d) - project_cone(y, mu)).squaredNorm();
    const double tangential = y.tail(d - 1).norm();
    ++(mu * tangential <= -y[0] ? m.open : tangential < mu * y[0] ? m.stick : m.slip);
  }
  const double size = r.norm();
  m.residual = std::sqrt(square) / (size > 0 ? size : 1);
  return m;
}

Result solve(const ContactProblem& p, const solver::Method& method, Monitor& monitor) {
  const int d = p.dimension, contacts = p.contacts();
  problem::FrictionGroup friction{p.name, problem::coulomb({p.mu.begin(), p.mu.end()}), contacts, d - 1, {}};
  std::vector<int> order;  // of the contact problem's rows among those under laws
  for (int k = 0; k < contacts; ++k) order.push_back(k * d), friction.normal.push_back(k);
  for (int k = 0; k < contacts; ++k)
    for (int i = 1; i < d; ++i) order.push_back(k * d + i);
  problem::Problem rows;
  rows.B = algebra::SparseRows(p.rows(), 0);
  rows.c = Vector::Zero(p.rows());
  rows.groups.push_back({p.name, problem::unilateral(), 0, contacts});
  rows.friction.push_back(std::move(friction));
  Result result;
  result.iteration = method.run(rows, problem::CondensedProblem(p.W(order, order), -p.q(order)), monitor);
  result.r.resize(p.rows());
  result.r(order) = result.iteration.state.lambda;
  result.measure = measure(p, result.r);
  return result;
}

}  // namespace dotyk::fclib
