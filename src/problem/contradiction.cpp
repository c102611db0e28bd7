#include "problem/contradiction.hpp"

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Relative tolerance for one row to be a combination of others.
constexpr double kMadeUp = 1e-9;

/// The bilateral rows that act on each unknown.
std::map<int, std::set<int>> bilateral_rows(const Problem& problem) {
  std::map<int, std::set<int>> rows;
  for (const RowGroup& group : problem.groups)
    for (int i = 0; i < group.count; ++i)
      if (const auto k = group.law->linear_stiffness(i); k && std::isinf(*k))
        for (SparseRows::InnerIterator it(problem.B, group.first + i); it; ++it) rows[static_cast<int>(it.col())].insert(group.first + i);
  return rows;
}

/// The value that the bilateral rows `among` give to B_r u; nothing if they leave it free.
std::optional<double> held(const Problem& problem, int r, const std::set<int>& among) {
  std::map<int, Eigen::Index> place;  // of the unknowns in all these rows
  const auto take_unknowns = [&](int row) {
    for (SparseRows::InnerIterator it(problem.B, row); it; ++it) place.try_emplace(static_cast<int>(it.col()), static_cast<Eigen::Index>(place.size()));
  };
  take_unknowns(r);
  for (const int k : among) take_unknowns(k);
  const auto dense = [&](int row) {
    Vector v = Vector::Zero(static_cast<Eigen::Index>(place.size()));
    for (SparseRows::InnerIterator it(problem.B, row); it; ++it) v[place[static_cast<int>(it.col())]] = it.value();
    return v;
  };
  DenseMatrix others(static_cast<Eigen::Index>(place.size()), static_cast<Eigen::Index>(among.size()));
  Vector jumps(others.cols());
  Eigen::Index j = 0;
  for (const int k : among) others.col(j) = dense(k), jumps[j++] = problem.c[k];
  const Vector own = dense(r), parts = algebra::least_squares(others, own);
  if (!((own - others * parts).norm() <= kMadeUp * own.norm())) return std::nullopt;
  return parts.dot(jumps);
}

}  // namespace

std::optional<Contradiction> contradiction(const Problem& problem, double tol) {
  std::vector<int> violated;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r)
      if (problem.c[r] < -tol) violated.push_back(r);
  if (violated.empty()) return std::nullopt;  // mostly
  const std::map<int, std::set<int>> bilateral = bilateral_rows(problem);
  for (const int r : violated) {
    std::set<int> among;
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
      if (const auto found = bilateral.find(static_cast<int>(it.col())); found != bilateral.end()) among.insert(found->second.begin(), found->second.end());
    if (among.empty()) continue;
    if (const auto jump = held(problem, r, among); jump && *jump - problem.c[r] > tol) return Contradiction{r, *jump - problem.c[r]};
  }
  return std::nullopt;
}

}  // namespace dotyk::problem
