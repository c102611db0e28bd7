// Names at x = 1, 2, … in place of numbers.
#pragma once

#include "figure/canvas/axes.hpp"

namespace dotyk::figure {

// All in letters of one size: level, in one line or two, or upright where that is too wide.
class CategoryNames {
public:
  // With so many pixels from one to the next, in a picture so high.
  CategoryNames(const std::vector<std::string>& names, double em, double spacing, double height);
  double height() const { return height_; }  // pixels that they take below the axis
  void draw(Canvas& canvas, const Axes& axes) const;

private:
  std::vector<FittedText> names_;
  bool upright_ = false;
  double height_ = 0;
};

}  // namespace dotyk::figure
