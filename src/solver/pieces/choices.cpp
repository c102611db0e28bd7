#include "solver/pieces/choices.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

constexpr long kMostCombinations = 1L << 20;

void add_friction(const FrictionGroup& group, std::vector<Choice>& choices, const std::vector<int>& choice_of) {
  const auto refuse = [&](const char* why) {
    throw InputError(text("enumeration cannot treat ", group.name, ": ", why,
                          "; newton from several starts can (seed = 1, 2, …)"));
  };
  if (group.components != 1) refuse("in space slip has not finitely many pieces");
  for (int k = 0; k < group.points(); ++k) {
    const double slope = group.law->bound_slope(k), bound = group.law->bound(k, 0);
    if (slope == 0) {
      if (bound > 0) choices.push_back({.tangent = group.row(k), .pieces = 3, .bound = bound});
      continue;
    }
    const int at = choice_of[group.normal[k]];
    if (at < 0 || choices[at].tangent >= 0) refuse("its normal rows are not contact rows of one point each");
    choices[at].tangent = group.row(k);
    choices[at].coefficient = slope;
    choices[at].pieces = 4;
  }
}

}  // namespace

std::vector<Choice> choices_of(const Problem& problem) {
  std::vector<Choice> choices;
  std::vector<int> choice_of(problem.rows(), -1);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      choice_of[r] = static_cast<int>(choices.size());
      choices.push_back({.row = r});
    }
  for (const RowGroup& group : problem.groups)
    if (group.count > 0 && !group.law->unilateral() && !group.law->linear_stiffness(0))
      throw InputError(text("enumeration cannot treat the ", group.law->name(), " law of the ", group.name, group.law->springs(0) ? "; pdas can" : "; newton can"));
  for (const FrictionGroup& group : problem.friction) add_friction(group, choices, choice_of);
  double combinations = 1;
  for (const Choice& choice : choices) combinations *= choice.pieces;
  if (combinations > kMostCombinations)
    throw InputError(text("enumeration would try ", combinations, " combinations of the pieces of ", choices.size(),
                          " contact and friction points; it takes up to ", kMostCombinations));
  return choices;
}

}  // namespace dotyk::solver
