#pragma once

#include <functional>
#include <optional>

#include "solver/feti/face_coarse.hpp"
#include "solver/feti/feti.hpp"
#include "solver/feti/piece_stiffness.hpp"

namespace dotyk::solver {

/// What Feti takes for (PFP + ρQ)⁻¹ on a face in its inner conjugate gradients: as Feti::preconditioner and
/// Feti::face_coarse say, M being none, the lumped or the Dirichlet preconditioner and θ ≥ ‖PFP‖,
///   with the coarse space of the face     W/θ, or WMW + (W − W²)/θ, whose second term is what the penalty leaves to W;
///   without                               nothing, or PMP + Q/ρ.
class FetiPreconditioner {
 public:
  /// `dual` and `coarse` must outlive the object. Throws as PieceStiffness does.
  FetiPreconditioner(const DualProblem& dual, const CoarseSpace& coarse, const Feti& method, Monitor& monitor);
  /// For Smalbe::preconditioner, empty where there is none. `set` and this must outlive it. θ: `norm`.
  std::function<algebra::Vector(const algebra::Vector& v, const algebra::Vector& x, const SeparableSet::Gradients& at, double rho)>
  on(const SeparableSet& set, double norm);
  double factor_bytes() const { return stiffness_ ? stiffness_->factor_bytes() : 0; }

 private:
  /// Springs are as pieces of one unknown each, whose B̂WKWB̂ᵀ is the square of the greatest stiffness times their compliance.
  algebra::Vector M(const algebra::Vector& v) const { return stiffness_->apply(v) + springs_.cwiseProduct(v); }
  algebra::Vector whole(const algebra::Vector& v, double rho) const;
  algebra::Vector face(const algebra::Vector& v, double norm) const;

  const CoarseSpace& coarse_;
  algebra::Vector springs_;
  FaceCoarse face_;
  bool on_face_;
  std::optional<PieceStiffness> stiffness_;
};

}  // namespace dotyk::solver
