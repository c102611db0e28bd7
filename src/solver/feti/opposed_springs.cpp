#include "solver/feti/opposed_springs.hpp"

#include "problem/law/limited.hpp"

namespace dotyk::solver {

using algebra::SparseRows;
using problem::Law;
using problem::Limits;
using problem::Problem;
using problem::RowGroup;

namespace {

bool has_two_springs(const RowGroup& group) {
  for (int r = 0; r < group.count; ++r)
    if (problem::kinked_at_zero(*group.law, r)) return true;
  return false;
}

std::shared_ptr<const Law> half(const RowGroup& group, bool above) {
  std::vector<Limits> rows;
  for (int r = 0; r < group.count; ++r) {
    const problem::Springs k = group.law->springs(r).value();
    rows.push_back(above ? Limits{k.above, 0, Law::kUnbounded} : Limits{k.below, -Law::kUnbounded, 0});
  }
  return problem::limited(group.law->name(), std::move(rows));
}

/// Which row of `problem` every row of opposed_springs() is or was split from.
std::vector<int> rows_split(const Problem& problem) {
  std::vector<int> from;
  for (int r = 0; r < problem.rows(); ++r) from.push_back(r);
  for (const RowGroup& group : problem.groups)
    for (int r = 0; has_two_springs(group) && r < group.count; ++r) from.push_back(group.first + r);
  return from;
}

}  // namespace

bool has_two_springs(const Problem& problem) {
  for (const RowGroup& group : problem.groups)
    if (has_two_springs(group)) return true;
  return false;
}

Problem opposed_springs(const Problem& problem) {
  Problem out = problem;
  const std::vector<int> from = rows_split(problem);
  int rows = problem.rows();
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const RowGroup& group = problem.groups[g];
    if (!has_two_springs(group)) continue;
    out.groups[g].law = half(group, true);
    out.groups.push_back({group.name, half(group, false), rows, group.count});
    rows += group.count;
  }
  std::vector<Eigen::Triplet<double>> entries;
  out.c.resize(rows);
  for (int r = 0; r < rows; ++r) {
    out.c[r] = problem.c[from[r]];
    for (SparseRows::InnerIterator it(problem.B, from[r]); it; ++it) entries.emplace_back(r, static_cast<int>(it.col()), it.value());
  }
  out.B = SparseRows(rows, problem.unknowns());
  out.B.setFromTriplets(entries.begin(), entries.end());
  if (problem.row_name) out.row_name = [name = problem.row_name, from](int row) { return name(from[row]); };
  return out;
}

Result joined(Result result, const Problem& problem) {
  const std::vector<int> from = rows_split(problem);
  const auto join = [&](auto& of_rows, auto&& both) {
    for (std::size_t r = problem.rows(); r < from.size(); ++r) of_rows[from[r]] = both(of_rows[from[r]], of_rows[r]);
  };
  join(result.state.lambda, [](double a, double b) { return a + b; });
  result.state.lambda.conservativeResize(problem.rows());
  for (auto& active : result.active_sets) {
    join(active, [](char a, char b) -> char { return a || b; });
    active.resize(problem.rows());
  }
  if (!result.slipping.empty()) result.slipping.resize(problem.rows());
  return result;
}

}  // namespace dotyk::solver
