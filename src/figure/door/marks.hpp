// Pictures read back: what draw() puts on the sheet about a solution, laid out but not rendered.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "figure/page/page_picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

// What a mark says ("slip", "load"), and where it stands, in the coordinates of the axes that it is drawn over.
struct DataMark {
  std::string what;
  std::vector<std::array<double, 2>> at;
};

// In the order in which they are drawn. Of scenes in the plane, and of maps:
//   "open", "closed", "stick", "slip"            a marker; with two points a stretch of the contact line
//   "pressure"                                   an ordinate: its foot at a node, its end
//   "shear", "load"                              an arrow: tail, head
//   "loaded"                                     the line along the outer ends of arrows, over all that is loaded
//   "obstacle"                                   its line
//   "fixed", "sliding", "displacement given", "spring", "open support"   where it holds the body, and its ground
// of plans of plates also "point support", and "pushing" or "pulling": an ordinate of the reaction of an edge, or a reaction at a point;
// of pages with beams: "beam", its line; "curve", of a diagram or a law; the names of states (state_name), with the moving end of an
// element below a beam at rest, as it is, and its ground, and the working point of a graph; of charts: "curve: NAME" and
// "markers: NAME" of a series, and "slope guide", the corners of its triangle. "legend: NAME", without points.
std::vector<DataMark> marks(const ScenePicture& picture);
std::vector<DataMark> marks(const PagePicture& picture);
std::vector<DataMark> marks(const PlatePicture& picture);
std::vector<DataMark> marks(const ChartPicture& picture);

}  // namespace dotyk::figure
