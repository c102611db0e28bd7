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
};

class Legend {
public:
  // em: height of the letters in pixels. columns_within: entries run in rows
  // no wider than this, longer names shortened; 0: one entry below the other.
  Legend(std::vector<LegendEntry> entries, double em, double columns_within = 0);

  bool empty() const { return entries_.empty(); }
  double width() const { return width_; }
  double height() const { return height_; }
  void draw(Canvas& canvas, Point lower_left, bool framed) const;

private:
  std::vector<LegendEntry> entries_;
  std::vector<Point> places_;  // lower left of each entry, from the block's top left
  double em_, width_ = 0, height_ = 0;
};

}  // namespace dotyk::figure
