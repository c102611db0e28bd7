#include "beam/solvable.hpp"

#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/solvability.hpp"

namespace dotyk::beam {

std::string theorem(const Beam& beam) {
  bool one_sided = false, elastic = false, sliding = false, turning = false;
  for (const Support& s : beam.supports) {
    one_sided |= s.deflection->stop();
    elastic |= problem::one_sided_spring(s.deflection);
    sliding |= s.deflection->yields();
    turning |= s.rotation->yields();
  }
  std::string out;
  if (elastic) out = "one-sided elastic supports: the load must press on both (theorem 2)";
  if (one_sided) out = "Signorini's supports: the load must press on both (theorem 3)";
  if (turning) out += (out.empty() ? "" : "; ") + std::string("friction against rotation: its bound must be above the load's moment (theorem 4)");
  if (sliding) out += (out.empty() ? "" : "; ") + std::string("friction against deflection: its bounds must be above the resultants (theorem 5)");
  return out;
}

std::string ends(double translation, double rotation) {
  Eigen::Vector2d u(translation - rotation / 2, translation + rotation / 2);
  u /= u.cwiseAbs().maxCoeff();
  for (double& end : u)
    if (std::abs(end) < 1e-9) end = 0;
  return text("u = ", u[0], " at the left end and ", u[1], " at the right one");
}

bool balanced(const problem::Problem& problem, const algebra::Vector& lambda) {
  constexpr double kMost = 1e-6;  // of all forces: what reactions may be wrong by; refinement leaves less with 9000 supports
  const problem::Block& beam = problem.blocks.front();
  const algebra::Vector reactions = problem.B.transpose() * lambda;
  return (beam.kernel.transpose() * (beam.f - reactions)).lpNorm<Eigen::Infinity>() <= kMost * (beam.f.lpNorm<1>() + reactions.lpNorm<1>());
}

std::string require_solvable(const Beam& beam, const Model& model) {
  using Verdict = problem::Solvability::Verdict;
  const auto rigid = problem::rigid_motions(model.problem);
  const auto s = problem::solvability(rigid, model.problem);
  if (s.verdict == Verdict::unique && !s.limit) return "";
  if (model.problem.rows() == 0 && model.problem.blocks.front().f.isZero(0)) throw InputError("nothing holds it, and nothing loads it");
  const double at_left = rigid.e[0] / 2 - rigid.e[1], at_right = rigid.e[0] / 2 + rigid.e[1];
  const std::string resultants = text("the resultants are ", at_left, " at the left end and ", at_right, " at the right one");
  if (s.verdict == Verdict::unsolvable) {
    const std::string why = theorem(beam);
    throw InputError(text("no solution: nothing stops the motion ", ends(s.motion[0], s.motion[1]), ", on which the load does work; ", resultants,
                          why.empty() ? "" : "; ", why, s.limit ? "; a limit case: a load less by a millionth has a solution" : ""));
  }
  std::string note = s.verdict == Verdict::up_to_motion ? text("unique up to the motion ", ends(s.motion[0], s.motion[1])) : "";
  if (s.limit) note += text(note.empty() ? "" : "; ", "a limit case: ", resultants);
  return note;
}

}  // namespace dotyk::beam
