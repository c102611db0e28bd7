#pragma once

#include <optional>

#include "mesh/box_tree.hpp"
#include "plate/samples.hpp"

namespace dotyk::plate {

/// The cell that a point lies in, and where. Throws InputError where it is not on the plate; `what`: for the message.
struct Place {
  int cell;
  Barycentric at;
};
class Finder {
 public:
  explicit Finder(const Space& space) : space_(space), cells_(mesh::boxes_of_cells(*space.mesh)) {}
  Place find(const Eigen::Vector2d& x, const std::string& what) const;
  std::optional<Place> find(const Eigen::Vector2d& x) const;

 private:
  const Space& space_;
  mesh::BoxTree cells_;
};

/// ∫ f v + loads on points, those of point supports included, and lines, of every freedom. What edges are loaded with by their laws is not in it. Throws InputError where
/// f is not finite, or a load is off the plate.
algebra::Vector loads(const Plate& plate, const Space& space);

/// Adds what laws of kind `load` do, and writes the values that act into the samples. Forces that vary along an edge act by their L² projection on the
/// linear functions of each side, so that their resultants are theirs up to Gauss's rule of three points, and what they do else to the order h⁴; moments by
/// their mean on a side (Morley) or Simpson's rule (HCT). On a side between whose nodes the law is no load, it
/// acts by its values at these nodes.
void add_law_loads(const Plate& plate, const Space& space, std::vector<Sample>& deflections, std::vector<Sample>& rotations, algebra::Vector& load);

}  // namespace dotyk::plate
