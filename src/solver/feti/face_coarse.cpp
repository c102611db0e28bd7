#include "solver/feti/face_coarse.hpp"

#include <cmath>
#include <stdexcept>

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Tangents may turn so far, as the square of the angle over θ/ρ, before the coarse problem is factored for them anew.
constexpr double kTurned = 0.1;

/// The greatest change of a tangent's component; the two are of one face.
double turn(const SparseMatrix& before, const SparseMatrix& now) {
  using Values = Eigen::Map<const Vector>;
  return (Values(now.valuePtr(), now.nonZeros()) - Values(before.valuePtr(), before.nonZeros())).lpNorm<Eigen::Infinity>();
}

}  // namespace

void FaceCoarse::move_to(const SeparableSet& set, const Vector& x, const SeparableSet::Gradients& at, double ratio) {
  const bool same = place_ == at.face && ratio_ == ratio;
  if (same && !at.slides) return;
  SparseMatrix T = set.directions(x, at);
  // ρQ sees a turn by ε as ρε² beside θ.
  if (same && turn(T_, T) <= std::sqrt(kTurned * ratio)) return;
  place_ = at.face;
  ratio_ = ratio;
  T_ = std::move(T);
  if (coarse_.modes() == 0) return;
  const SparseMatrix GT = coarse_.scaled_G() * T_;
  SparseMatrix S = ratio * coarse_.C();
  S += SparseMatrix(SparseMatrix(GT * SparseMatrix(GT.transpose())).triangularView<Eigen::Lower>());
  if (!factor_) factor_.emplace(coarse_.C());
  if (!factor_->factor(S, coarse_.held()))
    throw std::runtime_error("the coarse space of a face: its matrix has no factor");
}

Vector FaceCoarse::W(const Vector& v) const {
  if (coarse_.modes() == 0) return v;
  return v - E(coarse_.scaled_G().transpose() * factor_->solve(coarse_.scaled_G() * v).col(0));
}

}  // namespace dotyk::solver
