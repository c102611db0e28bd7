#pragma once

#include "solver/active/linearisation.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {

/// Where to begin an active-set iteration on rows that follow one another along edges (Problem::chains): the problem is first solved on a few
/// of them, each bearing what those about it could, by a barrier method, then on every second of the rest, and so on, by active sets; a row
/// begins on the piece of its law that its neighbours ended on, one between two different pieces on that which its displacement asks for. Without it
/// the number of iterations grows with the number of rows, since an end of a contact zone moves by few rows a step.
class NestedStart {
 public:
  NestedStart(const problem::Problem& problem, const problem::CondensedProblem& condensed, const algebra::Vector& rho);
  bool worthwhile() const { return stride_ > 1; }
  /// Linear solves on `step`, a problem of all rows; the linearisation to begin with there.
  Linearisation run(Step& step);
  int solves() const { return solves_; }

 private:
  enum class Piece : char { least, between, greatest };
  void keep(int stride);
  Linearisation begin() const;
  Linearisation linearise(const algebra::Vector& lambda, const algebra::Vector& x) const;
  void set(Linearisation& l, int row, double y) const;
  void set(Linearisation& l, int row, Piece piece) const;
  Piece piece(const Linearisation& l, int row) const;
  void spread(int stride, const Linearisation& l, const algebra::Vector& x);
  bool iterate(Step& step, Linearisation& l, algebra::Vector& x);
  bool by_barrier(Linearisation& l, algebra::Vector& x);

  const problem::Problem& problem_;
  const algebra::Vector& rho_;
  const problem::CondensedProblem& condensed_;
  std::vector<const problem::RowGroup*> group_;  ///< of a row
  std::vector<double> stands_for_;               ///< rows that a kept one stands for; 0: left out
  std::vector<Piece> pieces_;
  double force_ = 1;                             ///< scale of multipliers
  int stride_ = 1, solves_ = 0;
};

}  // namespace dotyk::solver
