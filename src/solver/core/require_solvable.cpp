#include "solver/core/require_solvable.hpp"

#include "algebra/direct/stop_factoring.hpp"
#include "base/stopwatch.hpp"
#include "problem/uniqueness.hpp"

namespace dotyk::solver {

namespace {

/// Motions that a message names; of more it tells how many.
constexpr std::size_t kNamed = 4;

/// "translation along x, translation along y and rotation about (0, 0)".
std::string all(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t k = 0; k < names.size(); ++k)
    out += (k == 0 ? "" : k + 1 < names.size() ? ", " : " and ") + names[k];
  return out;
}

/// Refuses a block that no row touches unless its load is in equilibrium, and not nothing.
void require_held(const problem::Block& block) {
  const double load = block.f.lpNorm<1>();
  if (block.hidden == 0 && load > 0 && (block.kernel.transpose() * block.f).lpNorm<Eigen::Infinity>() < 1e-10 * load) return;
  throw NotHeld(text("'", block.name, "' is not held: nothing stops its ", all(texts(block.motions)),
                        "; fix a part of it or put it in contact"));
}

void require_held(const problem::Problem& problem) {
  std::vector<char> touched(static_cast<std::size_t>(problem.unknowns()), 0);
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) touched[static_cast<std::size_t>(it.col())] = 1;
  for (const problem::Block& block : problem.blocks) {
    const auto first = touched.begin() + block.first;
    if (block.kernel.cols() > 0 && std::count(first, first + block.size(), 1) == 0) require_held(block);
  }
}

/// The motions that no row notices, by name where they are modes of their own, else by the first of them.
std::string unnoticed_motions(const problem::RigidMotions& rigid, const algebra::Vector& first) {
  std::vector<std::string> names;
  algebra::Vector parts = algebra::Vector::Zero(rigid.count());  // squares of the modes' lengths in the unnoticed motions
  for (int k = 0; k < rigid.unnoticed.cols(); ++k)
    for (algebra::SparseMatrix::InnerIterator it(rigid.unnoticed, k); it; ++it) parts[it.row()] += it.value() * it.value();
  for (Eigen::Index mode = 0; mode < parts.size(); ++mode)
    if (std::sqrt(parts[mode]) > 1 - 1e-9) names.push_back(rigid.motions[mode].text());
  const auto count = static_cast<std::size_t>(rigid.unnoticed.cols());
  if (count < 2) return describe(rigid.motions, first);
  if (names.size() == count && count > kNamed) {
    names.resize(kNamed);
    names.push_back(text(count - kNamed, " more"));
    return all(names);
  }
  return names.size() == count ? all(names) : text(count, " motions, one of them ", describe(rigid.motions, first));
}

/// What would stop a motion: of one body the support that holds it, by body and direction.
std::string what_would_hold(const std::vector<problem::BodyMotion>& modes, const algebra::Vector& amounts) {
  const std::vector<problem::BodyMotion> motions = told(modes, amounts);
  if (motions.size() != 1) return "Fix, slide or spring a part, add a contact in its way, or turn the load";
  const auto& [body, motion, sum] = motions.front();
  if (motion.kind == Motion::Kind::rotation)
    return "Fix or spring a part of '" + body + "' away from the " + (motion.direction.empty() ? "point" : "axis") + ", add a contact in its way, or turn the load";
  std::string axis = motion.direction_text(), way = "";
  if (along_axis(motion.direction)) {
    way = axis[0] == '-' ? " on the side of lesser " : " on the side of greater ";
    if (axis[0] == '-') axis.erase(0, 1);
    way += axis;
  }
  return text("Hold '", body, "' along ", axis, " (", way.empty() ? "a slide" : "fix \"" + axis + "\"", " or a spring on a part of it), add a contact in its way", way,
              ", or turn the load");
}

}  // namespace

std::string unbalanced_motion(const problem::Problem& problem, const algebra::Vector& resultants) {
  const auto motions = problem::body_motions(problem);
  Eigen::Index mode = 0;
  if (resultants.size() == 0 || static_cast<Eigen::Index>(motions.size()) != resultants.size()) return "";
  const double greatest = resultants.cwiseAbs().maxCoeff(&mode);
  const algebra::Vector one = algebra::Vector::Unit(resultants.size(), mode) * (resultants[mode] < 0 ? -1 : 1);
  return text(", most of all ", describe(motions, one), ", with ", greatest, ". ", what_would_hold(motions, one));
}

void refuse_unbearable(const FrictionalMotion& on, const std::string& proof) {
  throw NotHeld(text("not held: friction cannot bear what nothing else stops, ", describe(on.rigid.motions, on.amounts), "; the load does work ",
                        on.work, " on a unit of this motion, and no pressures that the bodies can build up have friction enough (", proof, "). ",
                        what_would_hold(on.rigid.motions, on.amounts)));
}

void require_bearable(const problem::Problem& problem, const problem::CondensedProblem& condensed, Monitor& monitor) {
  const auto motion = stopped_by_friction_alone(problem);
  if (motion && friction_is_too_weak(problem, condensed, *motion, monitor))
    refuse_unbearable(*motion, "two convex programs over all forces in balance and within the cones of friction");
}

KnownBefore require_solvable(const problem::Problem& problem, const problem::RigidMotions& rigid) {
  require_held(problem);
  using Verdict = problem::Solvability::Verdict;
  const problem::Solvability s = problem::solvability(rigid, problem);
  if (s.verdict == Verdict::unsolvable)
    throw NotHeld(text("not held: nothing stops ", describe(rigid.motions, s.motion), "; the load does work ", s.work,
                          " on a unit of this motion", s.limit ? " (a limit case: turned by 1e-6 the load has a solution)" : "",
                          ". ", what_would_hold(rigid.motions, s.motion)));
  if (s.verdict == Verdict::unknown)
    return {s.carried ? "whether it is unique was unknown before solving" : "whether there is a solution was unknown before solving", s.carried};
  std::string note;
  const bool coulomb = problem::has_coulomb(problem);  // under it the stress need not be unique
  if (s.verdict == Verdict::up_to_motion)
    note = text(coulomb ? "a solution may be moved by " : "unique up to ", unnoticed_motions(rigid, s.motion), rigid.unnoticed.cols() == 0 ? ""
                : coulomb ? ", which no support or contact notices: the displacement is the least"
                          : ", which no support or contact notices: the stress is unique, the displacement is the least");
  if (s.limit) note += text(note.empty() ? "" : "; ", "a limit case: turned by 1e-6 (in radians), the load has no solution");
  return {note, true};
}

Solvable require_solvable(const problem::Problem& problem, problem::Clock& clock, Monitor& monitor) {
  const Stopwatch watch;
  monitor.phase("rigid motions");
  const algebra::StopFactoring stop(monitor);
  Solvable result{problem::rigid_motions(problem), ""};
  result.note = require_solvable(problem, result.rigid).note;
  clock.motions += watch.seconds();
  return result;
}

}  // namespace dotyk::solver
