#pragma once

#include "plate/solution.hpp"

namespace dotyk::plate {

/// What an edge does to the plate at a node of it.
struct EdgePoint {
  int vertex;
  double x, y;
  double at;           ///< along the edge, from its first node
  double length;       ///< that it stands for
  double deflection;
  double slope;        ///< ∂ₙu, mean of the edge's two sides
  double force;        ///< upwards, loads by laws included; HCT: also the couples that hold the slope along a smooth edge, as pairs of forces
  double moment;       ///< doing work on ∂ₙu: −Mₙ times length
  double per_length() const { return force / length; }
  problem::LawChoice deflection_law, rotation_law;
  problem::Status status;  ///< of the deflection: open where nothing holds it there; closed; friction: stick or slip
  bool corner;
};

/// Pieces of a part, each a line of points, counter-clockwise about the plate; a closed one repeats its first point at the end.
struct EdgeReaction {
  double force = 0;     ///< upwards, on the plate; at a corner of two parts each bears its share
  double length = 0;
  double open = 0;      ///< of that: where one-sided laws bear nothing; on either side of the last node that bears by the mean
  std::vector<std::vector<EdgePoint>> pieces;
};

/// Of a place in Plate::edges.
EdgeReaction reaction(const Solution& solution, int edge);

/// The force of a point support on the plate, by its place in Plate::supports.
double point_reaction(const Solution& solution, int support);

/// A force that an edge's reaction per length does not tell: at a corner the force less what its two sides carry there, by the
/// reaction per length of the next two nodes. None where the plate has lifted off.
struct CornerForce {
  int vertex;
  double x, y;
  double force;  ///< upwards, on the plate
};
std::vector<CornerForce> corner_forces(const Solution& solution);

}  // namespace dotyk::plate
