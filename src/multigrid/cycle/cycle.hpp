// Conjugate gradients with a V-cycle over a hierarchy.
#pragma once

#include <exception>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "multigrid/cycle/hierarchy.hpp"
#include "multigrid/cycle/sweeps.hpp"

namespace dotyk::multigrid {

/// One of them lives on each rank. All functions are collective, except the const ones.
class Cycle {
 public:
  Cycle(const Ranks& ranks, Piece piece);

  bool set(const Change& change) { return hierarchy_.set(change) && take_levels(change.shared); }
  HalfRows take_coarser() { return hierarchy_.take_coarser(); }  ///< as in Hierarchy
  const OwnLoad& coarser_load() const { return hierarchy_.coarser_load(); }
  const AllOwnFunctions& functions() const { return hierarchy_.functions(); }

  struct Solution {
    bool found = false;  ///< else x has no meaning: an indefinite matrix, too many iterations
    int iterations = 0;
    std::exception_ptr thrown;  ///< by the monitor
  };
  /// x with ‖b − A x‖ ≤ tolerance ‖b‖, by the residual that conjugate gradients carry along, which becomes `left`. Of this rank's rows. `most`: iterations that the
  /// rate of convergence may foretell. `monitor`: rank 0's, which each iteration asks, null on the others; where it throws, all stop.
  Solution solve(const std::vector<double>& b, double tolerance, double most, Monitor* monitor, std::vector<double>& x, std::vector<double>& left);

  /// fine = P coarse, P the functions of the next coarser mesh. Of this rank's rows of both.
  void interpolate(const std::vector<double>& coarse, std::vector<double>& fine);

  int levels() const { return hierarchy_.levels() + (whole_ ? whole_->levels() - 1 : 0); }
  double bytes() const { return bytes_; }  ///< of all ranks, after the last set()

 private:
  /// A level of hierarchy_, except the last one.
  struct Level {
    Sweeps sweeps;
    int count;  ///< of sweeps before the coarse correction, and after it
    OwnedVec left, change;
    OwnedVec coarse, correction;  ///< of the next level
  };

  /// x = M⁻¹ b, M the V-cycle from this level on.
  void descend(std::size_t level, Vec b, Vec x);
  void solve_last(Vec b, Vec x);  ///< by the factor, or by whole_
  int first_swept_twice() const;  ///< the level
  bool set(const AllNumbers& numbers);
  /// Prepares sweeps and factors for the numbers that hierarchy_ has. False where a matrix is found not to be positive definite. `shared`: as in Change.
  bool take_levels(const std::vector<int>& shared);
  bool take_last();

  const Ranks ranks_;
  Hierarchy hierarchy_;
  std::vector<Level> levels_;
  SharedRows shared_;
  // The last level. On one rank it is the coarsest: last_ has its full rows, coarsest_ their factor. On several ranks each has in whole_ a cycle of its own, with
  // all rows of this level and of the coarser ones.
  OwnedMat last_;
  OwnedKsp coarsest_;
  std::unique_ptr<Cycle> whole_;
  std::vector<int> counts_;  ///< its rows, by rank
  OwnedVec x_, left_, z_, p_, Ap_;  ///< of conjugate gradients
  double bytes_ = 0;
};

}  // namespace dotyk::multigrid
