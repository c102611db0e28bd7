// Which places of a plot are free; and a block of samples with names.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "figure/canvas/canvas.hpp"
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

struct LegendEntry {
  std::string name;
  // Draws the sample into the box; none: the name stands alone.
  std::function<void(Canvas&, const Box&)> sample;
  double width = 2;  // of the sample, in em
};

// How many pixels wider a row must be to have room for its longest name; 0: it has room.
struct Lack {
  double pixels = 0;
  std::string name;
};

class Legend {
public:
  // em: height of the letters in pixels. rows_within_pixels: entries take as few rows of at most this width as possible, and stand in columns if columns need no
  // more rows; longer names are shortened. 0: one entry below the other.
  Legend(std::vector<LegendEntry> entries, double em, double rows_within_pixels = 0);

  bool empty() const { return entries_.empty(); }
  double width() const { return width_; }
  double height() const { return height_; }
  const Lack& lack() const { return lack_; }
  void draw(Canvas& canvas, Point lower_left, bool framed) const;

private:
  void place_in_columns(std::size_t columns);
  void place_in_rows(std::size_t rows, double width);

  std::vector<LegendEntry> entries_;
  std::vector<Point> places_;  // lower left of each entry, from the block's top left
  double em_, width_ = 0, height_ = 0;
  Lack lack_;
};

}  // namespace dotyk::figure
