#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;

Vector friction_bounds(const Problem& problem, const Vector& lambda) {
  std::vector<double> bounds;
  for (const auto& [group, k, first, n] : problem.friction_points()) bounds.push_back(group.bound(k, lambda));
  return Eigen::Map<const Vector>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
}

Vector no_slip_bounds(const Problem& problem) {
  std::vector<double> bounds;
  for (const auto& [group, k, first, n] : problem.friction_points())
    bounds.push_back(group.law->follows(k) ? kNoSlip : group.law->bound(k, 0));
  return Eigen::Map<const Vector>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
}

Problem laws_of(const Problem& problem) {
  Problem rows;
  rows.B = algebra::SparseRows(problem.rows(), 0);
  rows.c = problem.c;
  rows.groups = problem.groups;
  rows.friction = problem.friction;
  rows.row_name = problem.row_name;
  return rows;
}

Vector project(const Problem& problem, const Vector& y, const Vector& rho, const Vector* bounds) {
  Vector lambda(y.size());
  for (const auto& [law, k, r] : problem.scalar_rows()) lambda[r] = law.project(k, y[r], rho[r]).lambda;
  Eigen::Index point = 0;
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    const auto own = y.segment(first, group.components);
    lambda.segment(first, group.components) = problem::disc_factor(own.norm(), bounds ? (*bounds)[point++] : group.bound(k, lambda)) * own;
  }
  return lambda;
}

}  // namespace dotyk::solver
