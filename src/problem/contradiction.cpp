#include "problem/contradiction.hpp"

#include <Eigen/QR>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Of a row: what is left of one that others make up, by rounding.
constexpr double kMadeUp = 1e-9;

std::vector<int> rigid_rows(const Problem& problem) {
  std::vector<int> rows;
  for (const RowGroup& group : problem.groups)
    for (int i = 0; i < group.count; ++i)
      if (const auto k = group.law->linear_stiffness(i); k && std::isinf(*k)) rows.push_back(group.first + i);
  return rows;
}

/// What the rigid rows `among` make of B_r u; nothing where they leave it free.
std::optional<double> held(const Problem& problem, int r, const std::set<int>& among) {
  if (among.empty()) return std::nullopt;
  std::map<int, int> place;  // of unknowns
  const auto entries = [&](int row) {
    std::vector<std::pair<int, double>> found;
    for (SparseRows::InnerIterator it(problem.B, row); it; ++it)
      found.push_back({place.insert({static_cast<int>(it.col()), static_cast<int>(place.size())}).first->second, it.value()});
    return found;
  };
  const auto own = entries(r);
  std::vector<std::vector<std::pair<int, double>>> others;
  std::vector<double> jumps;
  for (const int k : among) others.push_back(entries(k)), jumps.push_back(problem.c[k]);
  DenseMatrix A = DenseMatrix::Zero(static_cast<Eigen::Index>(place.size()), static_cast<Eigen::Index>(others.size()));
  Vector row = Vector::Zero(A.rows());
  for (const auto& [j, value] : own) row[j] = value;
  for (std::size_t k = 0; k < others.size(); ++k)
    for (const auto& [j, value] : others[k]) A(j, static_cast<Eigen::Index>(k)) = value;
  const Vector parts = A.colPivHouseholderQr().solve(row);
  if (!((row - A * parts).norm() <= kMadeUp * row.norm())) return std::nullopt;
  return parts.dot(Eigen::Map<const Vector>(jumps.data(), static_cast<Eigen::Index>(jumps.size())));
}

}  // namespace

std::optional<Contradiction> contradiction(const Problem& problem, double tol) {
  const std::vector<int> rigid = rigid_rows(problem);
  if (rigid.empty()) return std::nullopt;
  std::map<int, std::set<int>> of_unknown;
  for (const int r : rigid)
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it) of_unknown[static_cast<int>(it.col())].insert(r);
  for (const RowGroup& group : problem.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      if (!(problem.c[r] < -tol)) continue;
      std::set<int> among;
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
        if (const auto found = of_unknown.find(static_cast<int>(it.col())); found != of_unknown.end()) among.insert(found->second.begin(), found->second.end());
      if (const auto jump = held(problem, r, among); jump && *jump - problem.c[r] > tol) return Contradiction{r, *jump - problem.c[r]};
    }
  }
  return std::nullopt;
}

}  // namespace dotyk::problem
