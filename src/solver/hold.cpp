#include "solver/hold.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::Block;
using problem::Problem;

Holder::Holder(const Problem& problem) : problem_(problem) {
  int modes = 0;
  for (const Block& block : problem.blocks) modes += static_cast<int>(block.kernel.cols());
  N_ = DenseMatrix::Zero(problem.rows(), modes);
  e_ = Vector::Zero(modes);
  int k = 0;
  for (const Block& block : problem.blocks) {
    if (block.kernel.cols() == 0) continue;
    const int count = static_cast<int>(block.kernel.cols());
    N_.middleCols(k, count) = problem.rows_of(block) * block.kernel;
    e_.segment(k, count) = block.kernel.transpose() * block.f;
    for (const std::string& name : block.kernel_names) names_.push_back(text("'", block.name, "': ", name));
    k += count;
  }
  unilateral_.assign(problem.rows(), 0);
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      unilateral_[r] = group.law->unilateral();
}

std::string Holder::motion_text(const Vector& motion) const {
  std::string out;
  for (int k = 0; k < motion.size(); ++k)
    if (std::abs(motion[k]) > 0.1 * motion.lpNorm<Eigen::Infinity>())
      out += (out.empty() ? "" : " with ") + names_[k];
  return out;
}

int Holder::hold(std::vector<char>& active, const Vector& x) const {
  const int modes = static_cast<int>(e_.size());
  if (modes == 0) return 0;
  int added = 0;
  for (;;) {
    std::vector<int> rows;
    for (int r = 0; r < problem_.rows(); ++r)
      if (active[r]) rows.push_back(r);
    DenseMatrix held(std::max<std::size_t>(rows.size(), modes), modes);
    held.setZero();
    for (std::size_t k = 0; k < rows.size(); ++k) held.row(k) = N_.row(rows[k]);
    // Modes are scaled to unit greatest displacement, so 1e-9 of the largest is "not at all".
    const Eigen::JacobiSVD<DenseMatrix> svd(held, Eigen::ComputeFullV);
    const Vector s = svd.singularValues();
    int rank = 0;
    while (rank < modes && s[rank] > 1e-9 * std::max(1.0, s[0])) ++rank;
    if (rank == modes) return added;

    const DenseMatrix free = svd.matrixV().rightCols(modes - rank);
    Vector motion = free * (free.transpose() * e_);
    const bool driven = motion.norm() > 1e-10 * e_.norm() && e_.norm() > 0;
    if (!driven) motion = free.col(0);
    motion /= motion.lpNorm<Eigen::Infinity>();
    const Vector approach = N_ * motion;
    double first = INFINITY;
    for (int r = 0; r < problem_.rows(); ++r)
      if (!active[r] && unilateral_[r] && approach[r] > 1e-9) first = std::min(first, -x[r] / approach[r]);
    if (!std::isfinite(first) || !driven)
      throw InputError(text("not held: nothing ", driven ? "stops " : "decides ", motion_text(motion),
                            driven ? text("; the load does work ", e_.dot(motion),
                                          " on a unit of this motion. Fix, slide or spring a part, or "
                                          "add a contact in its way")
                                   : ". No load drives it and no support holds it: fix or slide a part"));
    for (int r = 0; r < problem_.rows(); ++r)
      if (!active[r] && unilateral_[r] && approach[r] > 1e-9 &&
          -x[r] / approach[r] <= first + 1e-9 * std::abs(first)) {
        active[r] = 1;
        ++added;
      }
  }
}

}  // namespace dotyk::solver
