#include "scene/solve/uniqueness.hpp"

#include <cmath>

#include "algebra/direct/stop_factoring.hpp"
#include "base/text.hpp"
#include "solver/core/require_solvable.hpp"

namespace dotyk::scene {
namespace {

std::string with_coulomb(const problem::Uniqueness& theory) {
  if (!theory.exists)
    return std::string("whether there is a solution, and only one, is unknown before solving: forces within the cones of friction balance "
                       "the load, but how great the pressure can be ") +
           (theory.held ? "is not bounded where rows depend on each other" : "depends on the deformation of bodies that nothing else holds");
  return theory.held ? "a solution exists; whether it is unique is unknown before solving: it is for small coefficients of friction "
                       "(scene:uniqueness() computes how small)"
                     : "a solution exists; whether it is unique is unknown before solving: bodies are free and friction is Coulomb's";
}

}  // namespace

KnownBefore known_before(const problem::Problem& problem, const problem::RigidMotions& rigid) {
  const auto [note, exists] = solver::require_solvable(problem, rigid);
  KnownBefore known{problem::uniqueness(rigid, problem), ""};
  problem::Uniqueness& theory = known.theory;
  if (!theory.coulomb) theory.exists = exists, theory.unique = theory.unique && exists && note.empty();
  if (!exists && !(theory.coulomb && theory.exists))
    known.text = "whether there is a solution, and only one, is unknown before solving: neither forces that balance the load were found nor a "
                 "motion that nothing stops";
  else if (theory.coulomb)
    known.text = with_coulomb(theory) + (note.empty() ? "" : "; " + note);
  else if (!note.empty())
    known.text = "a solution exists with unique stress, " + note;
  else if (theory.unique)
    known.text = rigid.count() == 0 ? "a unique solution exists: every body is held by its supports"
                 : theory.held      ? "a unique solution exists: supports and contacts hold every body"
                                    : "a unique solution exists: the load presses every free body against what holds it";
  else if (theory.motion.size() > 0)
    known.text = "a solution exists with unique stress, displacement up to " + describe(rigid.motions, theory.motion) +
                 ": what holds it may do so in a range of places";
  else
    known.text = "a solution exists with unique stress; whether its displacement is unique is unknown before solving: it is, unless "
                 "the contacts that hold leave a motion free, which the solution then names";
  return known;
}

UniquenessOfScene uniqueness(const Scene& scene, Monitor& monitor) {
  problem::Clock clock;
  const Model model = build(scene, clock, monitor);
  const algebra::StopFactoring stop(monitor);
  const problem::RigidMotions rigid = problem::rigid_motions(model.problem);
  const KnownBefore known = known_before(model.problem, rigid);
  UniquenessOfScene out{known.theory.exists, known.theory.unique, std::nullopt, known.text};
  if (!known.theory.coulomb || rigid.count() > 0 || !known.theory.exists) return out;
  const problem::CondensedProblem condensed(model.problem, rigid, algebra::Ordering::automatic, clock, monitor);
  out.factor = problem::uniqueness_factor(model.problem, condensed);
  if (!out.factor) return out;
  out.unique = *out.factor > 1;
  out.text = text("a solution exists; it is proved to be unique for coefficients of friction below ", *out.factor, " times these",
                  out.unique ? ": it is unique" : "; for greater ones that is unknown", " (dotyk.all_solutions lists all for few nodes in the plane)");
  return out;
}

}  // namespace dotyk::scene
