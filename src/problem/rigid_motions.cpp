#include "problem/rigid_motions.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/null_space.hpp"
#include "base/text.hpp"

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
    for (const Motion& motion : block.motions) motions.push_back({block.name, motion});
  return motions;
}

std::string describe(const std::vector<BodyMotion>& motions, const Vector& amounts) {
  if (motions.empty()) return "a motion without strain";  // of a problem that does not say what its modes are
  const double largest = amounts.lpNorm<Eigen::Infinity>();
  std::vector<int> terms;
  for (int k = 0; k < amounts.size(); ++k)
    if (std::abs(amounts[k]) > 1e-6 * largest) terms.push_back(k);
  if (terms.size() == 1 && amounts[terms[0]] < 0) {
    const auto& [body, motion] = motions[terms[0]];
    if (motion.kind == Motion::Kind::rotation) return motions[terms[0]].text() + " (backwards)";
    return BodyMotion{body, opposite(motion)}.text();
  }
  std::string out;
  for (int k : terms) {
    out += (out.empty() ? "" : ", ") + motions[k].text();
    if (terms.size() > 1) out += text(" by ", std::round(1e4 * amounts[k] / largest) / 1e4);
  }
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

SparseMatrix unnoticed_displacements(const Problem& problem, const RigidMotions& rigid) {
  return algebra::orthonormal(displacement(problem, rigid.unnoticed));
}

Vector least(const SparseMatrix& unnoticed, Vector u) {
  if (unnoticed.cols() > 0) u -= unnoticed * Vector(unnoticed.transpose() * u);
  return u;
}

}  // namespace dotyk::problem
