// Pages of plots: beams with their supports, diagrams, graphs of laws. As
// picture.hpp: plain data in the user's units, to be filled and drawn.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "figure/door/picture.hpp"

namespace dotyk::figure {

// ------------------------------------------------------------------- beams

// How an element of a support is drawn.
enum class ElementKind {
  none,
  fixed,         // held where it is
  spring,
  plate_spring,  // the beam rests on it, and lifts off
  stop,          // rigid, the beam rests on it
  slider,        // a rod between rubbing pads
  plate_slider,  // the same under a plate on which the beam rests
  capped_spring, // a spring on such a rod
  breaking_spring,
  paired_springs // one pushes, beside it another pulls
};

enum class SupportState { acting, open, pushing, pulling, stick, slip, broken };

struct SupportElement {
  ElementKind kind = ElementKind::none;
  SupportState state = SupportState::acting;
  double slip = 0;  // how far a capped spring's rod has slipped, as the displacement
};

// A support of a beam: what it does about the deflection stands below the
// beam; what it does about the rotation is an arc above.
struct BeamSupport {
  double x = 0;
  double deflection = 0, rotation = 0;
  double rest = 0, rest_rotation = 0;  // at which its elements are at rest
  SupportElement below, arc;
  bool directed_arc = false;  // differs between slopes above and below zero
};

// Forces upwards, moments anticlockwise.
struct BeamLoad {
  double x = 0, force = 0, moment = 0;
};

// The deflection line, exaggerated, over the axis; supports; loads.
struct BeamDrawing {
  double length = 1;
  std::vector<double> x, deflection;  // ascending from 0 to length
  std::vector<double> load;           // per length, at the same points; empty: none
  std::vector<BeamLoad> loads;
  std::vector<BeamSupport> supports;
  std::string force_unit, moment_unit, load_unit;  // beside loads; may be empty
};

// ------------------------------------------------------------------ curves

struct PageCurve {
  std::vector<double> x, y;
  bool dashed = false;
};

// Curves over the plane, or the area between one and zero.
struct CurveDrawing {
  std::vector<PageCurve> curves;
  int colour = 0;                                  // series_colour
  bool area = false;                               // filled down to zero, the extreme values written beside
  std::optional<std::array<double, 2>> x_range, y_range;  // default: that of the column; the data with a margin
  bool no_scale = false;                           // y is zero or infinite: only zero is labelled
  std::vector<std::array<double, 2>> forbidden;    // x that cannot be: shaded
  std::optional<std::array<double, 2>> point;      // a working point, with its coordinates
  SupportState state = SupportState::acting;       // of the support there
};

// ------------------------------------------------------------------- pages

struct PageCell {
  std::string title, x_label, y_label;
  std::variant<BeamDrawing, CurveDrawing> drawing;
};

// Cells in rows and columns. Cells of a column have their axes above each other. States of supports that occur
// are told by the legend.
struct PagePicture : Sheet {
  std::vector<std::vector<PageCell>> rows;  // of equal length
  std::vector<double> column_weights, row_weights;  // shares of width and height, positive
  bool shared_x = false;                    // one x axis a column, labelled below the last row
};

// "acting", "open", "pushing", "pulling", "sticking", "slipping, at its limit", "broken".
const char* state_name(SupportState state);
Colour state_colour(SupportState state);

// As the other pictures: see picture.hpp.
void draw(const PagePicture& picture);

}  // namespace dotyk::figure
