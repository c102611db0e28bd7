#pragma once

#include <optional>

#include "solver/bounded/separable_set.hpp"
#include "solver/feti/coarse_space.hpp"
#include "solver/feti/feti.hpp"
#include "solver/feti/piece_stiffness.hpp"

namespace dotyk::solver {

/// The coarse problem of a face. On a face of directions T (SeparableSet::directions), E = TTᵀ, the penalty ρQ of the
/// augmented Lagrangian is no projector any more, and its spectrum spreads over [0, ρ]. What θI + ρQ is there has the
/// inverse (Woodbury)
///   W/θ,   W = E − EG̃ᵀ(θ/ρ C + G̃EG̃ᵀ)⁻¹G̃E,
/// which for ρ ≫ θ is the projector to the multipliers of the face that leave the balance alone. As a preconditioner
/// it makes conjugate gradients in the face those of PFP with that balance, whatever ρ is.
class FaceCoarse {
 public:
  explicit FaceCoarse(const CoarseSpace& coarse) : coarse_(coarse) {}
  /// Takes the face of x, unless it has it already, with tangents of sliding pairs that have turned since by an angle of
  /// at most √(0.1 θ/ρ): E is then of these tangents, a preconditioner as before. `ratio`: θ/ρ.
  void move_to(const SeparableSet& set, const algebra::Vector& x, const SeparableSet::Gradients& at, double ratio);
  /// W v, E v = v.
  algebra::Vector W(const algebra::Vector& v) const;
  /// E v.
  algebra::Vector E(const algebra::Vector& v) const { return T_ * (T_.transpose() * v); }

 private:
  const CoarseSpace& coarse_;
  std::vector<SeparableSet::Place> place_;
  double ratio_ = 0;
  algebra::SparseMatrix T_;
  std::optional<HeldFactor> factor_;
};

/// What Feti takes for (PFP + ρQ)⁻¹ on a face in its inner conjugate gradients: as Feti::preconditioner and
/// Feti::face_coarse say, M being none, the lumped or the Dirichlet preconditioner and θ ≥ ‖PFP‖,
///   with the coarse space of the face     W/θ, or WMW + (W − W²)/θ, whose second term is what the penalty leaves to W;
///   without                               nothing, or PMP + Q/ρ.
class FetiPreconditioner {
 public:
  /// `dual` and `coarse` must outlive the object. Throws as PieceStiffness does.
  FetiPreconditioner(const DualProblem& dual, const CoarseSpace& coarse, const Feti& method, Monitor& monitor);
  /// Empty where there is none. `set` and this must outlive it. θ: `norm`.
  PenaltyFaceMap on(const SeparableSet& set, double norm);
  double factor_bytes() const { return stiffness_ ? stiffness_->factor_bytes() : 0; }

 private:
  /// Springs are as pieces of one unknown each, whose B̂WKWB̂ᵀ is the square of the greatest stiffness times their compliance.
  algebra::Vector M(const algebra::Vector& v) const { return stiffness_->apply(v) + springs_.cwiseProduct(v); }

  const CoarseSpace& coarse_;
  algebra::Vector springs_;
  FaceCoarse face_;
  bool on_face_;
  std::optional<PieceStiffness> stiffness_;
};

}  // namespace dotyk::solver
