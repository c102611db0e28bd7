#include "solver/feti/feti_preconditioner.hpp"

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

FetiPreconditioner::FetiPreconditioner(const DualProblem& dual, const CoarseSpace& coarse, const Feti& method,
                                       Monitor& monitor)
    : coarse_(coarse), springs_(dual.torn().stiffest * (dual.torn().stiffest * dual.torn().compliance)), face_(coarse),
      on_face_(method.face_coarse) {
  if (method.preconditioner == Feti::Preconditioner::lumped) stiffness_.emplace(dual);
  if (method.preconditioner == Feti::Preconditioner::dirichlet) stiffness_.emplace(dual, method.ordering, monitor);
}

PenaltyFaceMap FetiPreconditioner::on(const SeparableSet& set, double norm) {
  using Gradients = SeparableSet::Gradients;
  if (on_face_)
    return [this, &set, norm](const Vector& v, const Vector& x, const Gradients& at, double rho) -> Vector {
      face_.move_to(set, x, at, norm / rho);
      const Vector Wv = face_.W(v);
      if (!stiffness_) return Wv / norm;
      const Vector left = (v - Wv) / norm;
      return face_.W(face_.E(M(Wv)) + left);
    };
  if (!stiffness_) return {};
  return [this](const Vector& v, const Vector&, const Gradients&, double rho) -> Vector {
    const Vector Qv = coarse_.Q(v);
    return coarse_.P(M(v - Qv)) + Qv / rho;
  };
}

}  // namespace dotyk::solver
