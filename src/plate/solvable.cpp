#include "plate/solvable.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "problem/solvability.hpp"

namespace dotyk::plate {

using problem::LawChoice;
using algebra::Vector;

namespace {

/// Of x, at this λ: both ends the same but where λ is at a limit of the law, where φ* ends.
problem::Interval allowed(const problem::Law& law, int row, double lambda, double x, double noise) {
  const problem::Interval bounds = law.multipliers(row);
  problem::Interval out{x, x};
  if (lambda <= bounds.low + noise) out.low = -INFINITY, out.high = problem::following(law, row).low;
  if (lambda >= bounds.high - noise) out.high = INFINITY, out.low = lambda <= bounds.low + noise ? -INFINITY : problem::following(law, row).high;
  return out;
}

/// Work on a motion below this part of the load counts as none: a little more than the motion's own rounding.
constexpr double kRounding = 1e-9;

/// Which kinds act, and what friction and caps can bear in all.
struct Kinds {
  bool signorini = false, one_sided_elastic = false, friction = false;
  double bound = 0;
};

Kinds kinds(const Model& model) {
  Kinds out;
  const auto note = [&](const LawChoice& law, double share) {
    out.signorini |= law->stop();
    out.one_sided_elastic |= problem::one_sided_spring(law);
    if (!law->yields()) return;
    out.friction = true;
    out.bound += share * law.bound();
  };
  for (const Sample& s : model.deflections) note(s.law, s.share);
  for (const PointSupport& s : model.plate.supports) note(s.deflection, 1);
  out.signorini |= !model.obstacle_row.empty();
  return out;
}

/// "translation along z" reads better as what it does to the plate.
std::string told(const Model& model, const problem::RigidMotions& rigid, const Vector& amounts) {
  if (model.problem.blocks.front().kernel.cols() == 1 && rigid.motions.front().motion.kind == Motion::Kind::translation)
    return amounts[0] > 0 ? "the motion of the whole plate upwards" : "the motion of the whole plate downwards";
  return "the motion " + problem::describe(rigid.motions, amounts);
}

/// What the rows could bear on the motion beyond the load's work on it.
double left_to_bear(const Model& model, const problem::RigidMotions& rigid, const Vector& amounts) {
  const Vector moved = rigid.N * amounts;
  const Vector rounding = 1e-9 * amounts.lpNorm<Eigen::Infinity>() * (rigid.N.cwiseAbs() * algebra::Vector::Ones(rigid.N.cols()));
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

Vector of_freedoms(const Model& model, const Vector& amounts) {
  const problem::Block& block = model.problem.blocks.front();
  Vector moved = block.kernel * amounts;
  Vector all = Vector::Zero(model.space.count());
  for (int i = 0; i < all.size(); ++i)
    if (model.unknown[i] >= 0) all[i] = moved[model.unknown[i]];
  return all / all.lpNorm<Eigen::Infinity>();
}

Vector by_motion(const algebra::SparseRows& B, const Vector& moved) {
  Vector by = B * moved;
  const double greatest = moved.size() ? moved.lpNorm<Eigen::Infinity>() : 0;
  for (int r = 0; r < B.rows(); ++r) {
    double sum = 0;
    for (algebra::SparseRows::InnerIterator it(B, r); it; ++it) sum += std::abs(it.value());
    if (std::abs(by[r]) <= 1e-9 * sum * greatest) by[r] = 0;
  }
  return by;
}

Family family(const Model& model, const problem::State& state, const Vector& motion) {
  const problem::Problem& problem = model.problem;
  const Vector moved = model.unknowns(motion);
  const Vector x = problem::jumps(problem, state.u), by = by_motion(problem.B, moved);
  const double noise = 1e-9 * std::max(state.lambda.size() ? state.lambda.lpNorm<Eigen::Infinity>() : 0.0, problem.blocks.front().f.lpNorm<Eigen::Infinity>());
  Family out{motion, -INFINITY, INFINITY};
  for (const problem::RowGroup& group : problem.groups)
    for (int k = 0; k < group.count; ++k) {
      const int r = group.first + k;
      if (by[r] == 0) continue;
      const problem::Interval at = allowed(*group.law, k, state.lambda[r], x[r], noise);
      double a = (at.low - x[r]) / by[r], b = (at.high - x[r]) / by[r];
      if (a > b) std::swap(a, b);
      out.from = std::max(out.from, a);
      out.to = std::min(out.to, b);
    }
  if (out.from > out.to) out.from = out.to = 0;
  const double rounding = 1e-12 * std::max(state.u.here().lpNorm<Eigen::Infinity>(), model.space.unit * 1e-3);
  for (double* end : {&out.from, &out.to})
    if (std::abs(*end) < rounding) *end = 0;
  return out;
}

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
