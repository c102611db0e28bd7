#include "problem/rigid_motions.hpp"

#include <iomanip>

#include "algebra/dense/null_space.hpp"

namespace dotyk::problem {

using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Loads that cancel to this part of what they are without their signs are balanced: the rest is rounding.
constexpr double kCancelled = 1e-13;

/// Rᵀf; zero where it is rounding.
Vector resultants(const Block& block, double sliced_load) {
  Vector e = block.kernel.transpose() * block.f, of_gross = block.kernel.cwiseAbs().transpose() * block.f.cwiseAbs();
  if (block.sliced_resultants.size() > 0) e += sliced_load * block.sliced_resultants, of_gross += std::abs(sliced_load) * block.gross_sliced_resultants;
  const double gross = of_gross.maxCoeff();
  return e.lpNorm<Eigen::Infinity>() > kCancelled * gross ? e : Vector::Zero(e.size());
}

}  // namespace

SparseMatrix jumps_of_modes(const Problem& problem) {
  algebra::Triplets entries;
  std::vector<int> first_mode{0};
  for (const Block& block : problem.blocks) first_mode.push_back(first_mode.back() + static_cast<int>(block.kernel.cols()));
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) {
      const std::size_t b = problem.block_of(it.col());
      const Block& block = problem.blocks[b];
      for (int k = 0; k < block.kernel.cols(); ++k) entries.emplace_back(r, first_mode[b] + k, it.value() * block.kernel(it.col() - block.first, k));
    }
  SparseMatrix N = algebra::from_triplets(problem.rows(), first_mode.back(), entries);
  N.prune([](int, int, double value) { return value != 0; });
  return N;
}

RigidMotions rigid_motions(const Problem& problem) {
  RigidMotions rigid;
  rigid.N = jumps_of_modes(problem);
  rigid.e = Vector::Zero(rigid.N.cols());
  rigid.motions = body_motions(problem);
  algebra::RangeAndNull two = algebra::range_and_null(rigid.N, kNotAtAll);
  rigid.noticed = std::move(two.seen);
  rigid.unnoticed = std::move(two.unseen);
  if (rigid.unnoticed.cols() == 0) rigid.noticed.setIdentity();  // the modes as they are named
  rigid.noticed_N = rigid.N * rigid.noticed;
  take_load(problem, rigid);
  return rigid;
}

void take_load(const Problem& problem, RigidMotions& rigid) {
  Eigen::Index k = 0;
  for (const Block& block : problem.blocks) {
    const Eigen::Index count = block.kernel.cols();
    if (count > 0) rigid.e.segment(k, count) = resultants(block, problem.sliced_load);
    k += count;
  }
  rigid.noticed_e = rigid.noticed.transpose() * rigid.e;
}

std::vector<BodyMotion> body_motions(const Problem& problem) {
  std::vector<BodyMotion> motions;
  for (const Block& block : problem.blocks)
    for (const Motion& motion : block.motions) motions.push_back({block.name, motion, block.motions.sum});
  return motions;
}

std::vector<BodyMotion> told(const std::vector<BodyMotion>& modes, const Vector& amounts) {
  constexpr double kRest = 1e-6;  // of the greatest amount: what solvers leave in motions
  const Vector part = amounts.unaryExpr([greatest = amounts.lpNorm<Eigen::Infinity>()](double a) { return std::abs(a) > kRest * greatest ? a / greatest : 0; });
  std::vector<BodyMotion> all;
  for (Eigen::Index first = 0, end = 0; first < part.size() && !modes.empty(); first = end) {
    const auto& [body, motion, sum] = modes[static_cast<std::size_t>(first)];
    while (end < part.size() && modes[static_cast<std::size_t>(end)].body == body) ++end;
    const Vector own = part.segment(first, end - first);
    if (own.isZero(0)) continue;
    if (sum) all.push_back({body, sum(own)});
    for (Eigen::Index k = first; !sum && k < end; ++k)
      if (part[k] != 0) all.push_back({body, times(part[k], modes[static_cast<std::size_t>(k)].motion)});
  }
  return all;
}

std::string describe(const std::vector<BodyMotion>& modes, const Vector& amounts) {
  if (modes.empty()) return "a motion without strain";  // of a problem that does not say what its modes are
  const std::vector<BodyMotion> motions = told(modes, amounts);
  std::string out;
  for (const BodyMotion& one : motions)
    out += (out.empty() ? "" : ", ") + one.text() + (motions.size() > 1 ? text(" by ", std::setprecision(4), std::abs(one.motion.amount)) : "");
  return out;
}

SparseMatrix displacement(const Problem& problem, const SparseMatrix& motions) {
  std::vector<const Block*> block_of;
  std::vector<int> mode_of;
  for (const Block& block : problem.blocks)
    for (int k = 0; k < block.kernel.cols(); ++k) block_of.push_back(&block), mode_of.push_back(k);
  algebra::Triplets entries;
  for (int j = 0; j < motions.cols(); ++j)
    for (SparseMatrix::InnerIterator it(motions, j); it; ++it) {
      const Block& block = *block_of[static_cast<std::size_t>(it.row())];
      const auto mode = block.kernel.col(mode_of[static_cast<std::size_t>(it.row())]);
      for (int i = 0; i < block.size(); ++i)
        if (mode[i] != 0) entries.emplace_back(block.first + i, j, mode[i] * it.value());
    }
  return algebra::from_triplets(problem.unknowns(), motions.cols(), entries);
}

Vector rigid_part(const Block& block, const Vector& u) { return block.kernel * algebra::least_squares(block.kernel, u); }

SparseMatrix unnoticed_displacements(const Problem& problem, const RigidMotions& rigid) {
  return algebra::orthonormal(displacement(problem, rigid.unnoticed));
}

Vector least(const SparseMatrix& unnoticed, Vector u) {
  if (unnoticed.cols() > 0) u -= unnoticed * Vector(unnoticed.transpose() * u);
  return u;
}

}  // namespace dotyk::problem
