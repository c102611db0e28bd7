// Colours of a field, and the bar that explains them.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include "figure/canvas/axes.hpp"
#include "figure/canvas/window.hpp"

namespace dotyk::figure {

struct ColourScale {
  bool shown = false;      // some body has values, or the picture fixes a range
  bool diverging = false;
  double low = 0, high = 1;            // what the bar shows
  double least = 0, greatest = 0;      // of the field itself

  // Ends of the colours: low and high, or symmetric about zero.
  double from() const;
  double to() const;
  Colour at(double value) const;
};

// Shortens the range of the colours where the field has a peak, so that a peak does not leave few colours to the rest. An end of the range moves to the
// 99th percentile of the values on its side if the peak is more than half as high again, and by more than a share of the range, which rounding is not.
void leave_out_peaks(ColourScale& scale, std::vector<double> values);

// Of all the bodies, or of what the window shows of them.
ColourScale colour_scale(const ScenePicture& picture, const std::optional<Box>& window);

vtkSmartPointer<vtkLookupTable> lookup_table(const ColourScale& scale);

// The ticks of a bar where it is not too short for them.
Ticks bar_ticks(const ColourScale& scale);

// What a bar of colours is of; without a name there is none.
struct FieldLabel {
  std::string name, unit;
};
inline FieldLabel field_of(const ScenePicture& picture) { return {picture.field_label, picture.field_unit}; }

// The upright bar with ticks, extremes and label, and a triangle on an end beyond which the field goes on: the least height with which it is legible, where its
// name is broken into lines no wider than `width`; its width; and its drawing at the left of a room.
double least_bar_height(const ColourScale& scale, const FieldLabel& field, double em, double width);
double colour_bar_width(const ColourScale& scale, const FieldLabel& field, double em);
void draw_colour_bar(Canvas& canvas, const ColourScale& scale, const FieldLabel& field, double em, const Box& room);

}  // namespace dotyk::figure
