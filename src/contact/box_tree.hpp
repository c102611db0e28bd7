#pragma once

#include <array>
#include <cmath>

#include "mesh/box_tree.hpp"

namespace dotyk::contact {

using mesh::Box, mesh::BoxTree;

/// All places within `radius` of a line.
class Tube {
 public:
  /// `axes`: unit, perpendicular to the line and to each other; in the plane the second is 0.
  Tube(const mesh::Point& on_line, const std::array<mesh::Point, 2>& axes, double radius) : on_line_(on_line), axes_(axes), radius_(radius) {}
  /// False only where the tube and the box have no point in common (they are apart along one of the axes).
  bool meets(const Box& box) const {
    for (const mesh::Point& axis : axes_) {
      double middle = 0, half = 0;
      for (int i = 0; i < 3; ++i) {
        middle += axis[i] * ((box.low[i] + box.high[i]) / 2 - on_line_[i]);
        half += std::abs(axis[i]) * (box.high[i] - box.low[i]) / 2;
      }
      if (std::abs(middle) > (1 + 1e-6) * (half + radius_)) return false;
    }
    return true;
  }

 private:
  mesh::Point on_line_;
  std::array<mesh::Point, 2> axes_;
  double radius_;
};

}  // namespace dotyk::contact
