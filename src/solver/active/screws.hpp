#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "algebra/dense/decompositions.hpp"
#include "solver/active/step.hpp"
#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Magnetic screws (TR965 1.2.2): unilateral rows taken as closed, and rows of given friction taken as stuck where those leave motions along
/// the contact free ((3.32), p(v) = 0), as many as there are rigid motions that rows notice, such that they hold them all: N_S is regular
/// (lemmas 1.10–1.12; the determinant of remark 1.6). Motions that no row notices (a planar contact's without friction, a surface of
/// revolution's) are held by the condition that their amount is zero, the report's p(v) = 0 (1.77).
class Screws {
 public:
  /// N, e: those of the motions that rows notice, Nᵀλ = e. `rows`: where they are placed, or empty for an automatic choice: the rows that
  /// carry the load in the sparsest equilibrium of the rigid bodies (their predicted pressures are positive), completed
  /// by rows next to them. Throws InputError where the rows given are too few or too many, repeat, or
  /// do not hold every motion.
  Screws(const problem::Problem& problem, algebra::DenseMatrix N, algebra::Vector e, std::vector<int> rows);

  const std::vector<int>& rows() const { return rows_; }
  /// Ratio of the least to the greatest singular value of N_S: near zero where screws hold badly.
  double regularity() const;
  /// |det N_S|, the modes' greatest displacement being 1 (remark 1.6).
  double determinant() const;
  int moves() const { return moves_; }

  /// Moves the screw that pulls most, or bears most beyond its friction bound (else the next such), to the row nearest along N that presses or sticks and
  /// keeps N_S regular, never back to a placement. False where none does (beyond `noise`) or nothing is left to try.
  bool move(const algebra::Vector& lambda, double noise);
  bool pulls(const algebra::Vector& lambda, double noise) const;

 private:
  bool move(int screw, const algebra::Vector& lambda, double noise);
  void complete();
  bool regular(const std::vector<int>& rows) const;
  /// Adds, in this order, rows that hold a motion more, by `least` of the greatest singular value.
  void add(const std::vector<int>& order, double least);
  /// How much the row's force is beyond what a screw there may bear, a force: it presses, or sticks, below 0.
  double excess(int row, const algebra::Vector& lambda) const;

  algebra::DenseMatrix N_;  ///< rows × noticed motions
  algebra::Vector e_;
  algebra::Vector low_, high_;              ///< of each row, what a screw may bear there: from 0 on, within the friction bound, or nothing
  std::vector<std::pair<int, int>> point_;  ///< of each row of friction, the first of its point and how many these are; else 0
  std::vector<int> rows_;
  std::set<std::vector<int>> tried_;  ///< placements, ascending
  int moves_ = 0;
};

/// A condensed problem held by screws, which is one without rigid motions: λ_S follows from global equilibrium (1.79)–(1.80),
/// N_Sᵀλ_S = e − N_Oᵀλ_O, and motions from x_S = 0. With E_S the columns of the identity and Q = I − N N_S⁻¹E_Sᵀ,
///   x = Q(x₀ − W E_S N_S⁻ᵀe) − QWQᵀλ',   λ = E_S N_S⁻ᵀe + Qᵀλ'.
class HeldByScrews {
 public:
  HeldByScrews(const problem::CondensedProblem& condensed, std::vector<int> screws);
  const std::vector<int>& screws() const { return screws_; }
  /// The problem of λ', which is 0 on the screws' rows.
  const problem::CondensedProblem& problem() const { return *problem_; }
  algebra::Vector multipliers(const algebra::Vector& other) const { return balance_ + Q_.transpose() * other; }
  /// The motions with which the screws are where they are.
  algebra::Vector amounts(const algebra::Vector& lambda) const;

 private:
  const problem::CondensedProblem& condensed_;
  std::vector<int> screws_;
  algebra::Lu motions_;  ///< N_S
  algebra::DenseMatrix Q_;
  algebra::Vector balance_;
  std::optional<problem::CondensedProblem> problem_;
};

/// One linear problem with the screws closed, by elimination.
std::unique_ptr<Step> screw_step(const problem::CondensedProblem& condensed, const algebra::Vector& rho,
                                 const Screws& screws);

/// Free bodies with given friction by magnetic screws (TR965 2.2, 3.2 (3.32)–(3.33), remark 3.5): contact rows taken as closed and, where
/// contact leaves motions along it free, friction rows taken as stuck, the report's p(v) = 0, hold all motions. Their multipliers follow
/// from equilibrium, so that `inner` works on a problem without motions (HeldByScrews). A screw that pulls, or bears more than its friction bound, is moved and the problem solved again.
struct WithScrews : RowMethod {
  std::shared_ptr<const RowMethod> inner;
  /// Rows on which the screws are placed first; empty: chosen.
  std::vector<int> screws;
  int max_moves = 50;
  const char* name() const override { return name_.c_str(); }
  void iterate(RowIteration& iteration) const override;
  /// Throws InputError for Coulomb friction, whose bound at a screw is not known.
  void require_treatable(const problem::Problem& problem) const override;

  explicit WithScrews(std::shared_ptr<const RowMethod> method);

 private:
  std::string name_;
};

}  // namespace dotyk::solver
