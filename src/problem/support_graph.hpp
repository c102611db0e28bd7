#pragma once

#include <vector>

#include "problem/law_choice.hpp"

namespace dotyk::problem {

/// Points of a plane, in order.
struct Curve {
  std::vector<double> x, y;
};

/// Where a graph is cut off: displacements low < high, reactions least < most.
struct GraphWindow {
  double low = -1, high = 1;
  double least = -1, most = 1;
};

/// The graph of a support's reaction r against its displacement v, r ∈ −∂φ(v), and its superpotential φ (P4, figures 1
/// to 17). All is piecewise linear but φ, whose parabolas are given by points.
struct SupportGraph {
  std::vector<Curve> reaction;  ///< (v, r), v ascending; where r has many values both ends of them, cut off by the window
  std::vector<Curve> jumps;     ///< of a breaking support: the reactions that it has in no state, at the v where it breaks
  Curve energy;                 ///< (v, φ) where φ is finite
  double low, high;             ///< φ is finite for low ≤ v ≤ high; infinite where nothing bounds v
};

SupportGraph graph(const LawChoice& law, const GraphWindow& window);

/// φ(v), force·length; infinite where the law forbids v. Of a breaking support ½k(v⁻)² up to what breaks it, limit²/2k.
double energy(const LawChoice& law, double v);

}  // namespace dotyk::problem
