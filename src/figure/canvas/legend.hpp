// A block of samples with names.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

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
