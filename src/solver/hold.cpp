#include "solver/hold.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::Problem;

namespace {

/// Motions that the active rows leave free, as an orthonormal basis.
DenseMatrix free_motions(const DenseMatrix& N, const std::vector<char>& active) {
  const Eigen::Index modes = N.cols();
  const Eigen::Index count = std::count(active.begin(), active.end(), 1);
  DenseMatrix held = DenseMatrix::Zero(std::max(count, modes), modes);
  Eigen::Index k = 0;
  for (std::size_t r = 0; r < active.size(); ++r)
    if (active[r]) held.row(k++) = N.row(static_cast<Eigen::Index>(r));
  const Eigen::JacobiSVD<DenseMatrix> svd(held, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  // Modes have greatest displacement 1: 1e-9 of that is "not at all".
  while (rank < modes && svd.singularValues()[rank] > 1e-9 * std::max(1.0, svd.singularValues()[0])) ++rank;
  return svd.matrixV().rightCols(modes - rank);
}

constexpr double kApproaches = 1e-9;  // of a unit motion; less is sliding along the row

}  // namespace

Holder::Holder(const Problem& problem, const problem::RigidMotions& rigid)
    : problem_(problem), rigid_(rigid), N_(rigid.noticed_N), e_(rigid.noticed_e) {
  unilateral_.assign(problem.rows(), 0);
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      unilateral_[r] = group.law->unilateral();
}

double Holder::distance(const Vector& approach, const std::vector<char>& active, const Vector& x) const {
  double first = INFINITY;
  for (int r = 0; r < problem_.rows(); ++r)
    if (!active[r] && unilateral_[r] && approach[r] > kApproaches) first = std::min(first, -x[r] / approach[r]);
  return first;
}

int Holder::hold(std::vector<char>& active, const Vector& x) const {
  if (e_.size() == 0) return 0;
  int added = 0;
  for (;;) {
    const DenseMatrix free = free_motions(N_, active);
    if (free.cols() == 0) return added;
    Vector motion = free * (free.transpose() * e_);
    if (!(motion.norm() > 1e-10 * rigid_.e.norm())) {
      // No load drives it: towards the nearer side, for a state that multipliers can belong to.
      motion = free.col(0);
      if (distance(-(N_ * motion), active, x) < distance(N_ * motion, active, x)) motion = -motion;
    }
    motion /= motion.lpNorm<Eigen::Infinity>();
    const Vector approach = N_ * motion;
    const double first = distance(approach, active, x);
    if (!std::isfinite(first))
      throw InputError(text("not held: nothing stops ", problem::describe(rigid_.motions, rigid_.noticed * motion),
                            "; fix, slide or spring a part, or add a contact in its way"));
    for (int r = 0; r < problem_.rows(); ++r)
      if (!active[r] && unilateral_[r] && approach[r] > kApproaches &&
          -x[r] / approach[r] <= first + 1e-9 * std::abs(first)) {
        active[r] = 1;
        ++added;
      }
  }
}

}  // namespace dotyk::solver
