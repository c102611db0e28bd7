// What the parts of a scene figure share while it is drawn.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "figure/canvas/canvas.hpp"
#include "figure/canvas/colour_map.hpp"
#include "figure/canvas/geometry.hpp"
#include "figure/canvas/legend.hpp"
#include "figure/door/picture.hpp"

class vtkRenderer;

namespace dotyk::figure {

struct Stage;

// What a kind of picture adds to a scene: names for the legend, the room that
// symbols want at the present scale, what is drawn below and above contacts
// and supports.
struct Additions {
  std::function<std::vector<LegendEntry>(const Stage&)> legend = {};
  std::function<void(const Stage&, Bounds&)> bounds = {};
  std::function<void(Stage&, vtkRenderer*)> below = {}, above = {};
  bool axes_of_bodies = false;  // plane: along the bodies, not all that stands around them
};

struct Stage {
  Stage(const ScenePicture& picture, int factor);

  const ScenePicture& picture;
  int factor;                 // rendered pixels per pixel
  bool plane;                 // 2-D
  double em;                  // height of letters, pixels
  ColourScale scale;
  View view;
  Box frame;                  // pixels within which the scene is drawn
  std::vector<std::array<Vec3, 2>> body_boxes;  // least and greatest reference corner of each body
  std::optional<Window> window;  // what the figure shows, where that is not all; at least the picture's
  double window_strip = 0;    // pixels of the greatest pressure in a window
  double greatest_pressure = 0, greatest_shear = 0;  // of what is seen
  bool deformation_shows = false;
  Canvas under, over;         // below and above the bodies
  Additions added;

  double strip_height() const;                    // pixels of the greatest pressure
  bool strips() const;                            // pressure as strips, not arrows
  bool arrows() const;
  Vec3 deformed(const Vec3& position, const Vec3& displacement) const;
  Vec3 place(const ContactNode& node) const { return deformed(node.position, node.displacement); }
  // In a window: the point lies in the frame, and `within` pixels off its rim.
  bool shows(Point p, double within = 0) const { return !window || frame.holds(p, -within); }
  bool shows(Point p, Point q) const { return !window || crop(p, q, frame); }
  // Of each node, whether it or some of its facets is seen.
  std::vector<bool> shown(const ContactPicture& contact) const;
  void set_greatest();
  // Numbers of those positions, given in the order of an edge's nodes, that
  // are shown, `within` the frame, and stand `spacing` pixels apart.
  std::vector<std::size_t> spaced(const std::vector<Point>& at, double spacing, double within = 0) const;
};

// Lays out, draws, and writes the file.
void draw_stage(Stage& stage);

// Chooses the view and the frame, and reserves room for title, legend, axes
// and colour bar; draws these.
void lay_out(Stage& stage);
// The rim of a window, above what it cuts off.
void draw_rim(Stage& stage);

// Fills and hatches obstacles in the plane; in space adds their surfaces.
void draw_obstacles(Stage& stage, vtkRenderer* renderer);
// Surfaces, mesh edges and outlines of the bodies.
void draw_bodies(Stage& stage, vtkRenderer* renderer);
// Status and pressure on the contact boundary.
void draw_contacts(Stage& stage, vtkRenderer* renderer);
// A plan of the contact of a scene in space: the width it wants (0: none),
// and its drawing in the room given to it.
double inset_width(const Stage& stage);
// The coordinates that span the plan: those across the normal, never mirrored.
struct Plan {
  std::size_t across, up;
  Point operator()(const Vec3& p) const { return {p[across], p[up]}; }
};
Plan plan_of(const ContactPicture& contact);
void draw_inset(Stage& stage, const Box& room);
// Arrows of the shear, in the plane beside the contact line on the side of the
// first part, which they act on; on the plan of a contact in space, whose
// nodes are drawn at `at` and whose coordinates are those two.
void draw_shear(Stage& stage, const ContactPicture& contact);
void draw_shear(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, std::size_t across, std::size_t up);
// The ends of a node's arrow in the plane.
std::array<Point, 2> shear_arrow(const Stage& stage, const ContactNode& node);
std::vector<LegendEntry> shear_legend(const Stage& stage);
// Of one contact in space: statuses and arrows of the pressure.
void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer);
// Symbols of supports, arrows of loads.
void draw_supports(Stage& stage);
void draw_loads(Stage& stage);

// The greatest pressure of a contact in words, beyond its ordinate and clear of
// outlines and obstacles; none where the contact carries (next to) nothing.
struct PeakLabel {
  std::string text;
  double size = 0;  // of the letters
  Point direction;  // outwards from the contact
  Box box;
};
std::optional<PeakLabel> peak_label(const Stage& stage, const ContactPicture& contact, bool within_frame = true);
// The end of the pressure ordinate of a node that is drawn at `at`.
Point pressure_tip(const Stage& stage, const ContactNode& node, Point at);

// Names of what the stage will show, for the legend.
std::vector<LegendEntry> contact_legend(const Stage& stage);
std::vector<LegendEntry> support_legend(const Stage& stage);

constexpr Colour pressure_line{45, 50, 90}, shear_line{150, 15, 40};
// Sizes of symbols in em, for the room they need.
constexpr double support_size = 0.85, load_length = 2.6, hatch_depth = 0.75;
// Where a load arrow begins and ends, in pixels.
std::array<Point, 2> load_arrow(const Stage& stage, const LoadArrow& load, double greatest);
double greatest_load(const ScenePicture& picture);

}  // namespace dotyk::figure
