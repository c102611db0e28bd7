// Pictures of plates. As picture.hpp: plain data in the user's units, to be
// filled and drawn. Deflections, forces and reactions are positive upwards
// (+z); reactions act on the plate: positive ones push, negative ones pull it down.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "figure/door/picture.hpp"

namespace dotyk::figure {

enum class PlateView {
  surface,  // in space, height = deflection × PlatePicture::deformation
  plan      // from above, with reactions along the edges
};

// What an edge or a point of the plate rests on.
enum class PlateSupport { free, held, one_sided, elastic, friction };

struct EdgeSample {
  double share = 0;                         // along the piece: 0 at `from`, 1 at `to`
  double deflection = 0, reaction = 0;      // reaction: force per length
  std::optional<Status> status;             // none: the support has none
  bool extrapolated = false;                // the reaction, which then has no label
};

// A straight piece of the boundary, the plate to its left.
struct PlateEdge {
  std::array<double, 2> from = {0, 0}, to = {0, 0};
  PlateSupport support = PlateSupport::free;
  bool clamped = false;                     // cannot rotate
  std::vector<EdgeSample> samples;          // ascending, at both ends at least
};

// A concentrated reaction: at a corner, at a point support.
struct PlateForce {
  double x = 0, y = 0, force = 0;
};

struct PlatePointSupport {
  double x = 0, y = 0, deflection = 0;
  PlateSupport support = PlateSupport::held;
  std::optional<Status> status;
};

struct PlatePicture : Sheet {
  PlatePicture() : Sheet{{}, 1200, 1100, {}} {}
  std::string caption;                      // empty: none; the factor on the deflection is stated in any case
  PlateView view = PlateView::surface;

  std::vector<double> points;               // 2 n: x and y of the nodes
  std::vector<int> triangles;               // 3 nodes each
  std::vector<double> deflection;           // n
  double deformation = 1;                   // factor on the deflection in the surface
  std::vector<double> values;               // n: the field, or empty: plain colour
  std::string field_label, field_unit;      // beside the colour bar
  bool field_signed = false;                // as ScenePicture has it
  std::optional<std::array<double, 2>> field_range;  // {least, greatest}
  MeshEdges edges = MeshEdges::automatic;   // automatic in a plan: none

  std::vector<PlateEdge> boundary;          // each follows the one it begins at the end of, all around
  std::vector<PlateForce> forces;
  std::vector<PlatePointSupport> supports;
  std::vector<double> obstacle;             // n: heights of an obstacle under the plate, NaN where there is none; or empty
  std::vector<int> bearing;                 // nodes that bear on the obstacle
  std::vector<double> bears;                // n, above 0.5 in the zone that does; empty: 1 at `bearing`, 0 elsewhere
  std::vector<int> mesh_edges;              // of the mesh that was solved on, two nodes each; empty: the edges of the triangles
  std::string reaction_unit, force_unit;    // of reactions per length, of concentrated ones; may be empty
  std::string length_unit;                  // of the axes of a plan; may be empty
  std::optional<Vec3> view_from;            // surface: direction towards the eye
};

// As the other pictures: see picture.hpp.
void draw(const PlatePicture& picture);

}  // namespace dotyk::figure
