#include "solver/core/near_rows.hpp"

#include "solver/core/settled_overlap.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

/// Leaving rows out is worth it from so many rows on, and where it leaves out at least so many of a hundred.
constexpr int kFewRows = 150, kLeastLeftOut = 20;

/// How far rows overlap at rest or, where bodies are free, after they have settled; nothing where no row does.
std::optional<Vector> overlap(const Problem& problem) {
  const bool held = std::all_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.kernel.cols() == 0; });
  std::optional<Vector> all = held ? std::optional<Vector>(-problem.c) : settled_overlap(problem);
  const auto some = [&](const RowGroup& g) { return g.law->unilateral() && (all->segment(g.first, g.count).array() > 0).any(); };
  if (all && std::none_of(problem.groups.begin(), problem.groups.end(), some)) all.reset();
  return all;
}

/// Coulomb's friction goes with its normal row; given friction acts on open points as well.
void add_friction(const Problem& problem, std::vector<char>& near) {
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      if (group.normal[k] >= 0 && group.law->bound(k, 0) == 0)
        std::fill_n(near.begin() + group.row(k), group.components, near[group.normal[k]]);
}

}  // namespace

std::vector<char> rows_that_may_close(const Problem& problem) {
  const auto over = problem.rows() >= kFewRows ? overlap(problem) : std::nullopt;
  if (!over) return {};
  std::vector<char> near(problem.rows(), 1);
  for (const auto& [law, k, r] : problem.scalar_rows()) near[r] = !law.unilateral() || (*over)[r] >= 0;
  add_friction(problem, near);
  return 100 * std::count(near.begin(), near.end(), 0) < kLeastLeftOut * problem.rows() ? std::vector<char>() : near;
}

NearRows::NearRows(const Problem& problem, std::vector<char> near, const std::vector<char>& start) : RowSubset(problem) {
  for (std::size_t r = 0; r < start.size(); ++r) near[r] |= start[r];
  add_friction(problem, near);
  take(std::move(near));
}

bool NearRows::join(const Vector& u) {
  const Vector x = problem().B * u - problem().c;
  double most = 0;
  for (const RowGroup& group : problem().groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (!kept()[r]) most = std::max(most, x[r]);
  if (!(most > 0)) return false;
  std::vector<char> near = kept();
  for (const RowGroup& group : problem().groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (x[r] > -most) near[r] = 1;
  add_friction(problem(), near);
  take(std::move(near));
  return true;
}

}  // namespace dotyk::solver
