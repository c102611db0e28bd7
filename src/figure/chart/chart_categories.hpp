// Names at x = 1, 2, … in place of numbers.
#pragma once

#include "figure/canvas/axes.hpp"

namespace dotyk::figure {

// All in letters of one size: level, in up to three lines; if that is too wide, upright and in full length, for which the picture grows.
class CategoryNames {
public:
  // With so many pixels from one to the next.
  CategoryNames(const std::vector<std::string>& names, double em, double spacing);
  double height() const { return height_; }  // pixels that they take below the axis
  // Throws InputError if the names overlap even when they stand upright.
  void draw(Canvas& canvas, const Axes& axes) const;

private:
  std::vector<FittedText> names_;
  bool upright_ = false, crowded_ = false;
  double height_ = 0;
};

}  // namespace dotyk::figure
