#include "solver/rows/with_screws.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/uniqueness.hpp"
#include "solver/active/screws.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

/// The rows with their laws, those of screws without: λ' = 0 there.
Problem other_rows(const Problem& problem, const std::vector<int>& screws) {
  std::vector<char> screwed(static_cast<std::size_t>(problem.rows()), 0);
  Problem rows = laws_of(problem);
  rows.groups.clear(), rows.friction.clear();
  for (const int r : screws) screwed[r] = 1, rows.groups.push_back({"screw", problem::elastic({0.0}), r, 1});
  for (const RowGroup& group : problem.groups) {
    const auto end = screwed.begin() + group.first + group.count;
    if (std::find(screwed.begin() + group.first, end, 1) == end) rows.groups.push_back(group);
    else  // unilateral: one law for all its rows
      for (int r = group.first; r < group.first + group.count; ++r)
        if (!screwed[r]) rows.groups.push_back({group.name, group.law, r, 1});
  }
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int first = group.row(k), kept = static_cast<int>(std::count(screwed.begin() + first, screwed.begin() + first + group.components, 0));
      if (kept == 0) continue;
      const int from = kept == group.components || !screwed[first] ? first : first + 1;
      rows.friction.push_back({group.name, problem::tresca({group.law->bound(k, 0)}), from, kept, {-1}});
    }
  return rows;
}

}  // namespace

WithScrews::WithScrews(std::shared_ptr<const RowMethod> method)
    : RowMethod(), inner(std::move(method)), name_(text(inner->name(), " with screws")) {
  static_cast<Settings&>(*this) = *inner;
}

void WithScrews::require_treatable(const Problem& problem) const {
  inner->require_treatable(problem);
  if (problem::has_coulomb(problem))
    throw InputError("kernel = \"screws\" goes with given friction: the bound of Coulomb's at a screw is not known before its force is");
}

void WithScrews::iterate(RowIteration& it) const {
  if (it.condensed.kernel_size() == 0) return inner->iterate(it);
  Screws places(it.problem, it.condensed.N(), it.condensed.e(), screws);
  Settings settings = *inner;
  settings.tol = tol / 10;
  int iterations = 0;
  bool placed = true;
  while (placed && it.next()) {
    it.note({places.rows(), places.regularity(), places.determinant()});
    const HeldByScrews held(it.condensed, places.rows());
    const Problem rows = other_rows(it.problem, places.rows());
    InnerMonitor monitor(it.monitor());
    RowIteration other(rows, held.problem(), settings, inner->map_weight(), monitor);
    inner->iterate(other);
    const Result found = other.finish();
    iterations += found.iterations;
    const Vector lambda = held.multipliers(found.state.lambda);
    it.move_to(lambda, held.amounts(lambda));
    if (it.record()) break;
    // Where the inner method does not end, a screw may be where the solution slips.
    placed = places.moves() < max_moves && places.move(lambda, 1e-9 * lambda.lpNorm<Eigen::Infinity>());
    if (!placed) it.give_up(text(found.converged ? std::string() : "held by screws: " + found.reason + "; ", "a screw still pulls, or slips, after ", places.moves(),
                                " moves: where fewer points stick than motions are free no place is right; kernel = \"exact\" needs none"));
  }
  it.remark(text(iterations, " iterations of ", inner->name()));
}

}  // namespace dotyk::solver
