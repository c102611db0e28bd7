#include "solver/require_solvable.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

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
void require_held(const problem::Problem& problem, const problem::Block& block) {
  if (block.kernel.cols() == 0 || problem.rows_of(block).nonZeros() > 0) return;
  const double load = block.f.lpNorm<1>();
  if (load > 0 && (block.kernel.transpose() * block.f).lpNorm<Eigen::Infinity>() < 1e-10 * load) return;
  throw InputError(text("'", block.name, "' is not held: nothing stops its ", all(texts(block.motions)),
                        "; fix a part of it or put it in contact"));
}

/// The motions that no row notices, by name where they are modes of their own, else by the first of them.
std::string unnoticed_motions(const problem::RigidMotions& rigid, const algebra::Vector& first) {
  std::vector<std::string> names;
  for (Eigen::Index mode = 0; mode < rigid.unnoticed.rows(); ++mode)
    if (rigid.unnoticed.row(mode).norm() > 1 - 1e-9) names.push_back(rigid.motions[mode].text());
  const auto count = static_cast<std::size_t>(rigid.unnoticed.cols());
  if (count < 2) return describe(rigid.motions, first);
  if (names.size() == count && count > kNamed) {
    names.resize(kNamed);
    names.push_back(text(count - kNamed, " more"));
    return all(names);
  }
  return names.size() == count ? all(names) : text(count, " motions, one of them ", describe(rigid.motions, first));
}

/// What would stop a motion: for a single mode the support that holds it, by body and direction.
std::string what_would_hold(const std::vector<problem::BodyMotion>& motions, const algebra::Vector& amounts) {
  Eigen::Index mode;
  const double greatest = amounts.cwiseAbs().maxCoeff(&mode);
  if (amounts.cwiseAbs().sum() > (1 + 1e-6) * greatest)
    return "Fix, slide or spring a part, add a contact in its way, or turn the load";
  const auto& [body, motion] = motions[mode];
  if (motion.kind == Motion::Kind::rotation)
    return "Fix or spring a part of '" + body + "' away from the axis, add a contact in its way, or turn the load";
  const std::string axis = motion.direction_text();
  return text("Hold '", body, "' along ", axis, " (", along_axis(motion.direction) ? "fix \"" + axis + "\"" : "a slide",
              " or a spring on a part of it), add a contact in its way on the side of ",
              amounts[mode] > 0 ? "greater " : "lesser ", axis, ", or turn the load");
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

std::string require_solvable(const problem::Problem& problem, const problem::RigidMotions& rigid) {
  for (const problem::Block& block : problem.blocks) require_held(problem, block);
  using Verdict = problem::Solvability::Verdict;
  const problem::Solvability s = problem::solvability(rigid, problem);
  if (s.verdict == Verdict::unsolvable)
    throw InputError(text("not held: nothing stops ", describe(rigid.motions, s.motion), "; the load does work ", s.work,
                          " on a unit of this motion", s.limit ? " (a limit case: turned by 1e-6 the load has a solution)" : "",
                          ". ", what_would_hold(rigid.motions, s.motion)));
  std::string note;
  if (s.verdict == Verdict::up_to_motion)
    note = text("unique up to ", unnoticed_motions(rigid, s.motion), rigid.unnoticed.cols() > 0
                    ? ", which no support or contact notices: the stress is unique, the displacement is the least"
                    : "");
  if (s.limit) note += text(note.empty() ? "" : "; ", "a limit case: turned by 1e-6, the load has no solution");
  return note;
}

}  // namespace dotyk::solver
