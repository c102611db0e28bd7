// Which places of a plot are free.
#pragma once

#include <optional>
#include <vector>

#include "figure/canvas/plane.hpp"

namespace dotyk::figure {

// Points along everything drawn, a few pixels apart: what legends and labels must spare.
class Occupied {
public:
  void add(const std::vector<Point>& curve, const Box& inside);
  void add(const Box& box);
  bool meets(const Box& box) const;
  bool clear_of(const Box& box, double margin) const;  // is no point nearer than margin?
  double distance(const Box& box) const;  // to the nearest point, 0 inside

private:
  std::vector<Point> points_;
};

// The corner or edge of `room` where a block of this size meets no curve: its lower left.
std::optional<Point> free_place(const Occupied& occupied, const Box& room, Point size, double margin);

// Where in `room` the lower left of a block of this size stands next to the curves of `to`, rather than next to others, and rather
// below than above, but keeps `margin` clear of all that is occupied.
std::optional<Point> near_place(const Occupied& occupied, const Occupied& to, const Box& room, Point size, double margin);

// The same nearest to a point: where the middle of the block stands.
std::optional<Point> place_beside(const Occupied& occupied, const Box& room, Point at, Point size, double margin);

}  // namespace dotyk::figure
