#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

int friction_points(const Problem& problem) {
  int count = 0;
  for (const FrictionGroup& group : problem.friction) count += group.points();
  return count;
}

}  // namespace

Vector friction_bounds(const Problem& problem, const Vector& lambda) {
  Vector bounds(friction_points(problem));
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) bounds[point++] = group.bound(k, lambda);
  return bounds;
}

Vector no_slip_bounds(const Problem& problem) {
  Vector bounds = friction_bounds(problem, Vector::Zero(problem.rows()));
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point)
      if (group.law->bound_slope(k) > 0) bounds[point] = kNoSlip;
  return bounds;
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
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      lambda[r] = group.law->project(r - group.first, y[r], rho[r]).lambda;
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point) {
      const auto own = y.segment(group.row(k), group.components);
      const double bound = bounds ? (*bounds)[point] : group.bound(k, lambda);
      const double length = own.norm();
      lambda.segment(group.row(k), group.components) = length <= bound ? Vector(own) : Vector(bound / length * own);
    }
  return lambda;
}

}  // namespace dotyk::solver
