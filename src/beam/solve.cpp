#include "beam/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "beam/solvable.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/settle.hpp"

namespace dotyk::beam {

namespace {

constexpr int kMostBreaking = 12;

/// The condensed problem knows deflections between near supports as differences of those of the whole beam: beyond so many rows PDAS works on the
/// banded stiffness, which knows them from near by.
constexpr int kMostCondensed = 16;
/// The same where the beam is nearly_rigid().
constexpr int kMostRigid = 200;

/// Is no spring as stiff as the beam as a whole, a cell's stiffness over the cube of their number? What it bears is then known by its own yielding,
/// while the banded stiffness, 12 EJ/h³ beside the spring's, hides it.
bool nearly_rigid(const Model& model) {
  const algebra::Vector stiffness = model.problem.row_stiffness() / std::pow(static_cast<double>(model.nodes.size()), 3);
  return std::ranges::all_of(model.problem.scalar_rows(), [&](const problem::ScalarRow& row) {
    const auto springs = row.law.springs(row.k);
    return springs && std::max(springs->below, springs->above) <= stiffness[row.r];
  });
}

/// Where the choice of broken supports is what the displacements say.
bool consistent(const Beam& beam, const std::vector<Breaking>& which, const std::vector<Broken>& broken, const Solution& s) {
  for (std::size_t k = 0; k < which.size(); ++k) {
    const Support& support = beam.supports[which[k].support];
    const Reaction r = s.reaction(which[k].support);
    const auto& law = which[k].rotation ? support.rotation : support.deflection;
    const double against = which[k].rotation ? r.rotation - support.rotation_at : support.deflection_at - r.deflection;  // one-sided: deflections down, rotations up
    const bool beyond = law.stiffness() * against > law.bound();
    if (beyond != (broken[k] == Broken::yes)) return false;
  }
  return true;
}

solver::Result run(const Model& model, const std::string& note, const solver::Method& method, Monitor& monitor) {
  const int rows = model.problem.rows();
  const bool condensed = rows <= kMostCondensed || (rows <= kMostRigid && nearly_rigid(model));
  solver::Result result = solver::solve(model.problem, method, {}, monitor, condensed);
  if (result.converged && !balanced(model.problem, result.state.lambda)) {
    result.converged = false;
    result.reason = kUnbalanced;
  }
  const bool told = solver::settle(model.problem, {}, result).count > 0;
  if (!told && !note.empty() && result.reason.find("unique up to") == std::string::npos) result.reason += "; " + note;
  return result;
}

}  // namespace

std::vector<Branch> solve(const Beam& beam, const solver::Method& method, Monitor& monitor) {
  const std::vector<Breaking> which = breaking(beam);
  if (which.size() > kMostBreaking)
    throw InputError(text(which.size(), " supports may break; every choice of broken ones is solved, which is possible with ", kMostBreaking, " at most"));
  std::vector<Branch> minima, not_converged;
  std::optional<InputError> refused;
  bool holds = false;
  for (unsigned choice = 0; choice < 1u << which.size(); ++choice) {
    std::vector<Broken> broken;
    for (std::size_t k = 0; k < which.size(); ++k) broken.push_back(choice >> k & 1 ? Broken::yes : Broken::no);
    const Stopwatch total;
    Model model = build(beam, broken);
    const double assembly = total.seconds();
    std::string note;
    try {
      note = require_solvable(beam, model);
    } catch (const InputError& error) {
      if (which.empty()) throw;
      if (!refused) refused = error;
      continue;
    }
    solver::Result result = run(model, note, method, monitor);  // a method that cannot treat one choice would miss branches: let it say so
    result.clock.assembly += assembly;
    result.clock.total = total.seconds();
    holds = true;
    auto solution = std::make_shared<const Solution>(beam, std::move(model), std::move(result));
    if (consistent(beam, which, broken, *solution)) minima.push_back({broken, solution});
    else if (!solution->result().converged) not_converged.push_back({broken, solution});
  }
  if (minima.empty()) minima = not_converged;
  if (minima.empty() && holds) throw InputError("no solution: whichever supports are whole, one of them would break, and without them nothing holds the beam");
  if (minima.empty()) throw *refused;
  std::sort(minima.begin(), minima.end(), [](const Branch& a, const Branch& b) { return a.solution->energy() < b.solution->energy(); });
  return minima;
}

}  // namespace dotyk::beam
