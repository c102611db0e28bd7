#pragma once

#include <vector>

#include "beam/beam.hpp"
#include "problem/problem.hpp"

namespace dotyk::beam {

/// Rows of a support: −1 where it has none.
struct SupportRows {
  int node = 0;
  int deflection = -1, rotation = -1;  ///< x = given − w, w = u, or w = ∓ℓu' (see `turn`)
  double turn = 1;                     ///< the rotation's law is about v = turn·u': −1 for one-sided ones, u' ≤ 0
};

/// A beam as a problem: one block, unknowns (u, ℓu') node by node, so that all are lengths and all multipliers
/// forces; ℓ = length. No support is in the stiffness: the kernel is u = 1 and u = x/ℓ − ½.
struct Model {
  std::vector<double> nodes;
  double unit = 1;  ///< ℓ
  std::vector<SupportRows> supports;
  std::vector<int> foundation;  ///< the row of each node, −1: none; empty: no foundation
  /// The length that a node stands for: half of the cells about it.
  double share(int node) const;
  problem::Problem problem;
};

/// What breaking supports are taken for; in the order of the beam's supports, deflection before rotation.
enum class Broken : char { no, yes };

/// Throws InputError as require_valid(), and where EJ or the load is not what it must be at some x. `broken`: empty: none.
Model build(const Beam& beam, const std::vector<Broken>& broken = {});

/// The breaking supports of a beam: support and whether it is its rotation.
struct Breaking {
  int support;
  bool rotation;
};
std::vector<Breaking> breaking(const Beam& beam);

}  // namespace dotyk::beam
