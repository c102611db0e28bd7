#include "solver/active/hold.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/null_space.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;

namespace {

/// Motions that the active rows leave free, as an orthonormal basis.
SparseMatrix free_motions(const SparseRows& N, const std::vector<char>& active) {
  SparseMatrix held = N;
  held.prune([&](int row, int, double) { return active[static_cast<std::size_t>(row)] != 0; });
  // Modes have greatest displacement 1: 1e-9 of that is "not at all".
  return algebra::range_and_null(held, 1e-9).unseen;
}

constexpr double kApproaches = 1e-9;  // of a unit motion; less is sliding along the row

}  // namespace

Holder::Holder(const Problem& problem, const problem::RigidMotions& rigid)
    : problem_(problem), rigid_(rigid), N_(rigid.noticed_N), e_(rigid.noticed_e) {
  following_.assign(problem.rows(), {-INFINITY, INFINITY});  // friction points: held as long as they stick
  multipliers_ = following_;
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      following_[r] = problem::following(*group.law, r - group.first), multipliers_[r] = group.law->multipliers(r - group.first);
}

double Holder::distance(int row, double approach, const Rows& at) const {
  const auto [low, high] = following_[row];
  const bool above = at.lambda[row] >= multipliers_[row].high;
  const double end = above ? high : low;
  if (at.active[row] || !std::isfinite(end) || multipliers_[row].low == multipliers_[row].high || !((above ? -approach : approach) > kApproaches)) return INFINITY;
  return (end - at.x[row]) / approach;
}

double Holder::distance(const Vector& approach, const Rows& at) const {
  double first = INFINITY;
  for (int r = 0; r < problem_.rows(); ++r) first = std::min(first, distance(r, approach[r], at));
  return first;
}

int Holder::hold(std::vector<char>& active, const Vector& x, const Vector& lambda) const {
  if (e_.size() == 0) return 0;
  const Rows at{active, x, lambda};
  int added = 0;
  for (;;) {
    const SparseMatrix free = free_motions(N_, active);
    if (free.cols() == 0) return added;
    Vector driving = e_;
    for (int r = 0; r < problem_.rows(); ++r)
      if (!active[r] && lambda[r] != 0) driving -= lambda[r] * Vector(N_.row(r).transpose());
    Vector motion = free * Vector(free.transpose() * driving);
    if (!(motion.norm() > 1e-10 * rigid_.e.norm())) {
      // No load drives it: towards the nearer side, for a state that multipliers can belong to.
      motion = free.col(0);
      if (distance(-(N_ * motion), at) < distance(N_ * motion, at)) motion = -motion;
    }
    motion /= motion.lpNorm<Eigen::Infinity>();
    const Vector approach = N_ * motion;
    const double first = distance(approach, at);
    if (!std::isfinite(first))
      throw InputError(text("not held: nothing stops ", problem::describe(rigid_.motions, rigid_.noticed * motion),
                            "; fix, slide or spring a part, or add a contact in its way"));
    for (int r = 0; r < problem_.rows(); ++r)
      if (distance(r, approach[r], at) <= first + 1e-9 * std::abs(first)) {
        active[r] = 1;
        ++added;
      }
  }
}

}  // namespace dotyk::solver
