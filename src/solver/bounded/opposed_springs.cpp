#include "solver/bounded/opposed_springs.hpp"

#include <numeric>

#include "algebra/pick_rows.hpp"
#include "problem/law/limited.hpp"

namespace dotyk::solver {

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

}  // namespace

bool has_two_springs(const Problem& problem) {
  for (const RowGroup& group : problem.groups)
    if (has_two_springs(group)) return true;
  return false;
}

OpposedSprings opposed_springs(const Problem& whole) {
  OpposedSprings out{whole, std::vector<int>(whole.rows())};
  Problem& problem = out.problem;
  std::iota(out.from.begin(), out.from.end(), 0);
  for (std::size_t g = 0; g < whole.groups.size(); ++g) {
    const RowGroup& group = whole.groups[g];
    if (!has_two_springs(group)) continue;
    problem.groups[g].law = half(group, true);
    problem.groups.push_back({group.name, half(group, false), static_cast<int>(out.from.size()), group.count});
    for (int r = 0; r < group.count; ++r) out.from.push_back(group.first + r);
  }
  problem.c = whole.c(out.from);
  problem.B = algebra::pick_rows(whole.B, out.from);
  if (whole.row_name) problem.row_name = [name = whole.row_name, from = out.from](int row) { return name(from[row]); };
  return out;
}

Result joined(Result result, const std::vector<int>& from, int rows) {
  const auto join = [&](auto& of_rows, auto&& both) {
    for (std::size_t r = rows; r < from.size(); ++r) of_rows[from[r]] = both(of_rows[from[r]], of_rows[r]);
  };
  join(result.state.lambda, [](double a, double b) { return a + b; });
  result.state.lambda.conservativeResize(rows);
  for (auto& active : result.active_sets) {
    join(active, [](char a, char b) -> char { return a || b; });
    active.resize(rows);
  }
  if (!result.slipping.empty()) result.slipping.resize(rows);
  return result;
}

}  // namespace dotyk::solver
