#pragma once

#include <vector>

#include "plate/element/element.hpp"

namespace dotyk::plate {

/// A point of a supported edge at which a law acts, for the length that it stands for.
struct Sample {
  int support;           ///< place in Plate::edges
  bool at_vertex;
  int place;             ///< node of the mesh, or edge
  std::array<int, 2> edges{-1, -1};  ///< of the part, that it is on: a slope is along the first one's normal
  bool along_node = false;  ///< a slope along the node's normal, not the edge's
  double share;          ///< length
  Eigen::Vector2d x;
  problem::LawChoice law;
  int row = -1;          ///< of the problem; −1: free, loaded, or held by freedoms
  double part_of_row = 1;  ///< share / all shares of its row
  bool held = false;     ///< its freedoms are held
};

/// The law of an edge's part at a point. Throws InputError, naming both, where it is not valid there or one that plates do not have.
problem::LawChoice law_at(const LawField& law, const std::string& part, const Eigen::Vector2d& x);

/// Where laws act. Those of the deflection, for half of either edge: the vertices. What they act on is with Morley's element the deflection there; with HCT its
/// mean about the vertex, weighted by the hat function, so that reactions are linear along an edge and the forces on the slopes are theirs, too:
/// forces at vertices alone would let edges sag between them, and leave of the order h² in energy h^1.5.
/// Those of the rotation: Morley: the edge middles; HCT: these and the vertices, by Simpson's rule.
std::vector<Sample> samples(const Plate& plate, const Space& space, bool rotation);

/// Along which a rotation's slope is: the normal of its edge, or of a smooth node.
Eigen::Vector2d slope_direction(const Space& space, const Sample& sample);

/// v of a law at a sample.
Functional deflection(const Space& space, const Sample& sample);
Functional rotation(const Space& space, const Sample& sample);

}  // namespace dotyk::plate
