// Texts of a plot: names of reference curves beside them, notes at points, and names at x = 1, 2, … in place of numbers.
#pragma once

#include <set>

#include "figure/canvas/axes.hpp"
#include "figure/chart/chart.hpp"

namespace dotyk::figure {

// Names at x = 1, 2, …, all in letters of one size: level, in up to three lines; if that is too wide, upright and in full length, for which the picture grows.
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

struct PlotText {
  FittedText words;
  Box box;
  Colour colour;
  bool upright = false;
  std::optional<std::array<Point, 2>> leader = {};  // from the point that is meant
};

// At free places; what they take is added to `occupied`. A reference curve beside which there is none is added to `crowded`, and
// has no name in the plot from then on. A note for which there is none becomes `crowded_note`. Throws InputError of a note beyond the axes.
using SeriesSet = std::set<const SeriesPicture*>;
std::vector<PlotText> plot_texts(const ChartPicture& picture, const ChartAxes& axes, Occupied& occupied, SeriesSet& crowded, const ChartNote*& crowded_note);
void draw(Canvas& canvas, const PlotText& text, double em);

}  // namespace dotyk::figure
