#pragma once

#include <vector>

#include "problem/condensed.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/step.hpp"

namespace dotyk::solver {

/// Magnetic screws (TR965 1.2.2): unilateral rows taken as closed, as many as there are rigid motions
/// that rows notice, such that they hold them all: N_S is regular (lemmas 1.10–1.12; the determinant
/// of remark 1.6). Motions that no row notices (a planar contact's, a surface of revolution's) are
/// held by the condition that their amount is zero, the report's p(v) = 0 (1.77).
class Screws {
 public:
  /// `rows`: where they are placed, or empty for an automatic choice: the rows that carry the load in
  /// the sparsest equilibrium of the rigid bodies (their predicted pressures are positive), completed
  /// by rows next to them. Throws InputError where the rows given are too few or too many, repeat, or
  /// do not hold every motion.
  Screws(const problem::Problem& problem, const problem::RigidMotions& rigid, std::vector<int> rows);

  const std::vector<int>& rows() const { return rows_; }
  /// Ratio of the least to the greatest singular value of N_S: near zero where screws hold badly.
  double regularity() const;
  /// |det N_S|, the modes' greatest displacement being 1 (remark 1.6).
  double determinant() const;
  int moves() const { return moves_; }

  /// Moves the screw with the most negative multiplier to the closed row with λ > 0 nearest along N
  /// that keeps N_S regular. False where none is negative (beyond `noise`) or nothing is left to try.
  bool move(const algebra::Vector& lambda, double noise);
  bool pulls(const algebra::Vector& lambda, double noise) const;

 private:
  void complete();
  bool regular(const std::vector<int>& rows) const;

  const problem::Problem& problem_;
  algebra::DenseMatrix N_;  ///< rows × noticed motions
  algebra::Vector e_;
  std::vector<int> rows_;
  std::vector<char> tried_;  ///< rows that a screw was moved away from
  int moves_ = 0;
};

/// One linear problem with the screws closed, by elimination: their multipliers follow from global
/// equilibrium (1.79)–(1.80), N_Sᵀ λ_S = e − N_Oᵀ λ_O, the rigid motions from x_S = 0, and what is
/// left for the other active rows is positive definite.
std::unique_ptr<Step> screw_step(const problem::CondensedProblem& condensed, const algebra::Vector& rho,
                                 const Screws& screws);

}  // namespace dotyk::solver
