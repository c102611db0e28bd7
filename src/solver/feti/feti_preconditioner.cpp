#include "solver/feti/feti_preconditioner.hpp"

namespace dotyk::solver {

using algebra::Vector;

FetiPreconditioner::FetiPreconditioner(const DualProblem& dual, const CoarseSpace& coarse, const Feti& method,
                                       Monitor& monitor)
    : coarse_(coarse), springs_(dual.torn().stiffest * (dual.torn().stiffest * dual.torn().compliance)), face_(coarse),
      on_face_(method.face_coarse) {
  if (method.preconditioner == Feti::Preconditioner::lumped) stiffness_.emplace(dual);
  if (method.preconditioner == Feti::Preconditioner::dirichlet) stiffness_.emplace(dual, method.ordering, monitor);
}

std::function<Vector(const Vector& v, const Vector& x, const SeparableSet::Gradients& at, double rho)> FetiPreconditioner::on(
    const SeparableSet& set, double norm) {
  if (on_face_)
    return [this, &set, norm](const Vector& v, const Vector& x, const SeparableSet::Gradients& at, double rho) {
      face_.move_to(set, x, at, norm / rho);
      return face(v, norm);
    };
  if (!stiffness_) return {};
  return [this](const Vector& v, const Vector&, const SeparableSet::Gradients&, double rho) { return whole(v, rho); };
}

Vector FetiPreconditioner::whole(const Vector& v, double rho) const {
  const Vector Qv = coarse_.Q(v);
  return coarse_.P(M(v - Qv)) + Qv / rho;
}

Vector FetiPreconditioner::face(const Vector& v, double norm) const {
  const Vector Wv = face_.W(v);
  if (!stiffness_) return Wv / norm;
  const Vector left = (v - Wv) / norm;
  return face_.W(face_.E(M(Wv)) + left);
}

}  // namespace dotyk::solver
