#include "problem/rigid_motions.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "algebra/dense.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Splits the motions into those that rows notice and the null space of N.
void split(RigidMotions& rigid) {
  const int modes = rigid.count();
  rigid.noticed = rigid.unnoticed = DenseMatrix(modes, 0);
  if (modes == 0) return;
  DenseMatrix square = DenseMatrix::Zero(std::max<Eigen::Index>(rigid.N.rows(), modes), modes);
  square.topRows(rigid.N.rows()) = rigid.N;
  const Eigen::JacobiSVD<DenseMatrix> svd(square, Eigen::ComputeFullV);
  int rank = 0;
  // Modes have greatest displacement 1: 1e-9 of that is "not at all".
  while (rank < modes && svd.singularValues()[rank] > 1e-9 * std::max(1.0, svd.singularValues()[0])) ++rank;
  rigid.noticed = svd.matrixV().leftCols(rank);
  if (rank == modes) rigid.noticed.setIdentity();  // the modes as they are named
  rigid.unnoticed = svd.matrixV().rightCols(modes - rank);
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
  rigid.noticed_N = rigid.N * rigid.noticed;
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
