#include "plate/solvable.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "plate/family.hpp"
#include "problem/solvability.hpp"

namespace dotyk::plate {

using problem::SupportLaw;
using Kind = SupportLaw::Kind;

namespace {

/// Work on a motion below this part of the load counts as none: a little more than the motion's own rounding.
constexpr double kRounding = 1e-9;

/// Which kinds act, and what friction and caps can bear in all.
struct Kinds {
  bool signorini = false, one_sided_elastic = false, friction = false;
  double bound = 0;
};

Kinds kinds(const Model& model) {
  Kinds out;
  const auto note = [&](const SupportLaw& law, double share) {
    out.signorini |= law.kind == Kind::signorini;
    out.one_sided_elastic |= law.kind == Kind::one_sided_elastic || law.kind == Kind::compliance || (law.kind == Kind::unequal_elastic && (law.value == 0) != (law.pull == 0));
    const bool yields = law.kind == Kind::capped_elastic, rubs = law.kind == Kind::friction || law.kind == Kind::one_sided_friction;
    out.friction |= yields || rubs;
    out.bound += share * (yields ? law.limit : rubs ? law.value : 0);
  };
  for (const Sample& s : model.deflections) note(s.law, s.share);
  for (const PointSupport& s : model.plate.supports) note(s.deflection, 1);
  out.signorini |= !model.obstacle_row.empty();
  return out;
}

/// "translation along z" reads better as what it does to the plate.
std::string told(const Model& model, const problem::RigidMotions& rigid, const algebra::Vector& amounts) {
  if (model.problem.blocks.front().kernel.cols() == 1 && rigid.motions.front().motion.kind == Motion::Kind::translation)
    return amounts[0] > 0 ? "the motion of the whole plate upwards" : "the motion of the whole plate downwards";
  return "the motion " + problem::describe(rigid.motions, amounts);
}

/// What the rows could bear on the motion beyond the load's work on it.
double left_to_bear(const Model& model, const problem::RigidMotions& rigid, const algebra::Vector& amounts) {
  const algebra::Vector moved = rigid.N * amounts;
  const algebra::Vector rounding = 1e-9 * amounts.lpNorm<Eigen::Infinity>() * (rigid.N.cwiseAbs() * algebra::Vector::Ones(rigid.N.cols()));
  double sum = -rigid.e.dot(amounts);
  for (const problem::RowGroup& group : model.problem.groups)
    for (int k = 0; k < group.count; ++k) {
      const double by = moved[group.first + k];
      const auto [low, high] = group.law->multipliers(k);
      if (std::abs(by) > rounding[group.first + k]) sum += by * (by > 0 ? high : low);
    }
  return sum;
}

}  // namespace

std::string conditions(const Model& model) {
  const Kinds is = kinds(model);
  std::string out;
  const auto add = [&](const std::string& condition) { out += (out.empty() ? "" : "; ") + condition; };
  if (!is.signorini && !is.one_sided_elastic && !is.friction) add("nothing but the load acts on it: its resultant and moments must vanish (P5 (33)), where they are functions as quadrature takes them and to 1e-6 of all forces");
  if (is.signorini) add("one-sided supports: the load must press on them, its resultant < 0 (P5 (45))");
  if (is.friction) add(text("friction: the resultant must be below all that it can bear, ", is.bound, " (P5 (63))"));
  if (is.one_sided_elastic) add("one-sided elastic supports: the load must press on them, its resultant < 0 (P5 (74), where u counts downwards)");
  return out;
}

Verdict require_solvable(const Model& model) {
  using Outcome = problem::Solvability::Verdict;
  const problem::Block& block = model.problem.blocks.front();
  if (block.kernel.cols() == 0) return {};
  if (model.problem.rows() == 0 && block.f.isZero(0)) throw InputError("nothing holds it, and nothing loads it");
  const auto rigid = problem::rigid_motions(model.problem);
  const auto s = problem::solvability(rigid, model.problem);
  if (s.verdict == Outcome::unique && !s.limit) return {};
  const std::string resultant = text("the load's resultant is ", model.load.dot(model.space.motions().col(0)));
  if (s.verdict == Outcome::unsolvable)
    throw InputError(text("no solution: nothing stops ", told(model, rigid, s.motion), ", on which the load does work; ", resultant, "; ",
                          conditions(model), s.limit ? "; a limit case: a load less by a millionth has a solution" : ""));
  Verdict out;
  if (rigid.unnoticed.cols() > 1) {
    out.note = rigid.unnoticed.cols() == 3 ? "unique up to all rigid motions, a + bx + cy; this one has (u, 1) = (u, x) = (u, y) = 0"
                                           : "unique up to several rigid motions that no support notices";
    return out;
  }
  // Beside the limit, by up to 1e-6 of the load, the solution is unique.
  const bool at_limit = !s.limit || left_to_bear(model, rigid, s.motion) <= kRounding * rigid.e.norm();
  if (s.verdict == Outcome::up_to_motion && at_limit) {
    out.note = text("unique up to ", told(model, rigid, s.motion));
    out.motion = of_freedoms(model, s.motion);
  }
  if (s.limit) out.note += text(out.note.empty() ? "" : "; ", at_limit ? "a limit case: " : "close to a limit case: ", resultant, "; ", conditions(model));
  return out;
}

}  // namespace dotyk::plate
