#pragma once

#include "beam/model.hpp"
#include "problem/residual.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::beam {

/// The state of a support.
struct Reaction {
  double force = 0, moment = 0;         ///< on the beam, up and anticlockwise; loads given as laws included
  double deflection = 0, rotation = 0;  ///< u and u' there
};

/// A solved beam. All of x must lie on the beam, else InputError.
class Solution {
 public:
  /// The result is judged: see solver::judge(), also for what it throws.
  Solution(Beam beam, Model model, solver::Result result);

  const Beam& beam() const { return beam_; }
  const Model& model() const { return model_; }
  const solver::Result& result() const { return result_; }
  const problem::Residual& residual() const { return residual_; }
  double energy() const { return residual_.energy; }  ///< with the supports', force·length

  double deflection(double x) const;  ///< of the cubic elements; with constant EJ exact at nodes
  double rotation(double x) const;
  /// M = −EJ u'' and T = DM of the exact solution of a beam under these loads and the reactions (a foundation's at the nodes): by
  /// equilibrium, from the left. At a point where they jump: their values to the right of it; at the right end to the left.
  double moment(double x) const;
  double shear(double x) const;
  /// The foundation's force on the beam at a node, up, and its force per length, between nodes linear; 0 without a row.
  double foundation_force(int node) const;
  double pressure(double x) const;
  /// Of a support of the beam, by its place in Beam::supports.
  Reaction reaction(int support) const;

 private:
  Eigen::Vector4d values(int cell) const;  ///< u, u', u, u' at its ends
  void sum_loads();
  double force_between(double from, double to) const;
  double moment_between(double from, double to) const;

  Beam beam_;
  Model model_;
  solver::Result result_;
  problem::Residual residual_;
  std::vector<PointLoad> forces_;            ///< point loads and reactions
  std::vector<double> sum_q_, sum_moment_;   ///< ∫ q and ∫ (x_i − s) q(s) ds from 0 to each node
};

}  // namespace dotyk::beam
