#include "problem/rigid_motions.hpp"

#include <cmath>

#include "algebra/dense.hpp"
#include "algebra/null_space.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Splits the motions into those that rows notice and the null space of N.
void split(RigidMotions& rigid) {
  // Modes have greatest displacement 1: 1e-9 of that is "not at all".
  algebra::RangeAndNull two = algebra::range_and_null(rigid.N, 1e-9);
  rigid.noticed = std::move(two.seen);
  rigid.unnoticed = std::move(two.unseen);
  if (rigid.unnoticed.cols() == 0) rigid.noticed.setIdentity();  // the modes as they are named
}

/// Loads that cancel to this part of what they are without their signs are balanced: the rest is rounding.
constexpr double kCancelled = 1e-13;

/// Rᵀf; zero where it is rounding.
Vector resultants(const Block& block) {
  const Vector e = block.kernel.transpose() * block.f;
  const double gross = (block.kernel.cwiseAbs().transpose() * block.f.cwiseAbs()).maxCoeff();
  return e.lpNorm<Eigen::Infinity>() > kCancelled * gross ? e : Vector::Zero(e.size());
}

}  // namespace

RigidMotions rigid_motions(const Problem& problem) {
  RigidMotions rigid;
  int modes = 0;
  for (const Block& block : problem.blocks) modes += static_cast<int>(block.kernel.cols());
  rigid.N = DenseMatrix::Zero(problem.rows(), modes);
  rigid.e = Vector::Zero(modes);
  int k = 0;
  for (const Block& block : problem.blocks) {
    const int count = static_cast<int>(block.kernel.cols());
    if (count == 0) continue;
    rigid.N.middleCols(k, count) = problem.rows_of(block) * block.kernel;
    k += count;
  }
  rigid.motions = body_motions(problem);
  split(rigid);
  rigid.noticed_N = rigid.unnoticed.cols() == 0 ? rigid.N : DenseMatrix(algebra::SparseMatrix(rigid.N.sparseView()) * rigid.noticed);
  take_load(problem, rigid);
  return rigid;
}

void take_load(const Problem& problem, RigidMotions& rigid) {
  Eigen::Index k = 0;
  for (const Block& block : problem.blocks) {
    const Eigen::Index count = block.kernel.cols();
    if (count > 0) rigid.e.segment(k, count) = resultants(block);
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

DenseMatrix displacement(const Problem& problem, const DenseMatrix& motions) {
  DenseMatrix u = DenseMatrix::Zero(problem.unknowns(), motions.cols());
  Eigen::Index mode = 0;
  for (const Block& block : problem.blocks) {
    u.middleRows(block.first, block.size()) = block.kernel * motions.middleRows(mode, block.kernel.cols());
    mode += block.kernel.cols();
  }
  return u;
}

DenseMatrix unnoticed_displacements(const Problem& problem, const RigidMotions& rigid) {
  return algebra::orthonormal(displacement(problem, rigid.unnoticed));
}

Vector least(const DenseMatrix& unnoticed, Vector u) {
  if (unnoticed.cols() > 0) u -= unnoticed * (unnoticed.transpose() * u);
  return u;
}

}  // namespace dotyk::problem
