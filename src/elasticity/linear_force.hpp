#pragma once

#include <memory>
#include <vector>

#include "base/lists.hpp"
#include "elasticity/load.hpp"

namespace dotyk::elasticity {

/// A force per volume that is linear in each cell, so that pieces of a cell, wherever they are cut, know theirs.
class LinearForce {
 public:
  LinearForce() = default;  ///< none
  /// In each cell the one that fits a field best, by least squares, at the points of the load rule. The field is asked once at each point.
  LinearForce(const mesh::Mesh& mesh, const VectorField& force);

  /// The force as a list of integers and one of real numbers, and the way back.
  Lists lists() const;
  LinearForce(const std::vector<int>& whole, std::vector<double> real);

  bool any() const { return numbers_ != nullptr; }
  bool varies() const { return !place_.empty(); }  ///< else it is one and the same everywhere
  mesh::Point at(int cell, const mesh::Point& x) const;
  /// The force in these cells, or in pieces of them, numbered as they come.
  LinearForce of(const std::vector<int>& cells) const;

 private:
  int dimension_ = 0;
  std::vector<int> place_;                               ///< of each cell, in numbers_
  std::shared_ptr<const std::vector<double>> numbers_;  ///< each: a point, the force there, its gradient row by row
};

}  // namespace dotyk::elasticity
