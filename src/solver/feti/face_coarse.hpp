#pragma once

#include <optional>

#include "solver/feti/coarse_space.hpp"
#include "solver/bounded/separable_set.hpp"

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

}  // namespace dotyk::solver
