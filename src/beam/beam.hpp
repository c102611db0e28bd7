#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problem/law_choice.hpp"

namespace dotyk::beam {

/// A support at a point: what it does about the deflection and the rotation there. One-sided laws keep the deflection
/// up (u ≥ 0) and the slope down (u' ≤ 0), as P4 does.
struct Support {
  std::string name;  ///< "left", "right", "x = 0.5": for messages and reactions
  double x = 0;
  problem::LawChoice deflection, rotation;
  double deflection_at = 0, rotation_at = 0;  ///< the laws are about u − deflection_at, u' − rotation_at
};

/// A law per length about the deflection u − at.
struct Foundation {
  problem::LawChoice law;
  double at = 0;
};

/// At a point; it may lie within a cell.
struct PointLoad {
  double x = 0;
  double force = 0;   ///< upwards
  double moment = 0;  ///< anticlockwise
};

/// A straight beam on 0 ≤ x ≤ length under Bernoulli's hypothesis:
///   minimise ∫ ½ EJ u''² − qu − Σ forces and moments + the supports' energies over u ∈ H²(0, length).
/// Deflection u positive upwards, rotation u'. Bending moment and shear force as in P4: M = −EJ u'', T = DM.
struct Beam {
  double length = 1;
  /// Cubic Hermite elements, at least; a support is always a node. At most 1000: K's condition, and so what rounding leaves,
  /// grows as their fourth power: 1e-12 of the deflection with 32, 1e-10 with 100, 1e-6 with 1000.
  int cells = 32;
  double EJ = 1;                           ///< force·length²; where there is no function
  std::function<double(double)> EJ_of;     ///< of x; empty: constant
  double q = 0;                            ///< load per length, upwards; where there is no function
  std::function<double(double)> q_of;      ///< of x; empty: constant
  std::vector<PointLoad> loads;
  std::vector<Support> supports;           ///< ascending in x
  /// At each of nodes(beam), where it stands for half of the cells about: of order 2 in their size. Empty: none. At a node that a
  /// support prescribes, a rigid law of the foundation has no row: its force there is the support's.
  std::vector<Foundation> foundation;
};

/// Throws InputError where the length or a stiffness is not positive, a point lies off the beam, two supports are at
/// one point or nearer than 1e-4 of the length, there are no cells, a law is not valid (problem::require_valid), the foundation has not one law
/// a node, one that may break or is a load, or one that is as rigid as a support's at the same node.
void require_valid(const Beam& beam);

/// Has the foundation a row at this node?
bool has_row(const Beam& beam, const std::vector<double>& nodes, int node);

/// The nodes, ascending: of cells of equal length, but that each support has moved the nearest one to its point, or has one
/// more where another support has that.
std::vector<double> nodes(const Beam& beam);

/// The cell that x lies in, of a node the one to its right where there is one, and where in it: 0 ≤ s ≤ 1. Throws InputError where x is not on
/// the beam.
struct Place {
  int cell;
  double s;
};
Place place(const std::vector<double>& nodes, double x);

/// The node next to x.
int nearest(const std::vector<double>& nodes, double x);

}  // namespace dotyk::beam
