// What the parts of a scene figure share while it is drawn, and the layers that it consists of.
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
#include "figure/canvas/paper.hpp"

class vtkRenderer;

namespace dotyk::figure {

struct Stage;

// A kind of thing that a scene shows; what it does not need is empty. Legends name layers in the order in which a
// stage has them; layers are drawn from the lowest height to the highest.
struct Layer {
  double height = 0;
  std::function<void(Stage&, vtkRenderer*)> draw = {};
  std::function<void(const Stage&, std::vector<LegendEntry>&)> legend = {};
  // The room that symbols want, which keep their size in pixels, at the present scale; asked from the highest to the lowest.
  std::function<void(const Stage&, Bounds&)> bounds = {};
};

struct Stage {
  // corner: the lower left pixel of the picture on its sheet.
  explicit Stage(const ScenePicture& picture, Point corner = {});

  const ScenePicture& picture;
  Point corner;
  int factor;                 // rendered pixels per pixel
  bool plane;                 // 2-D
  double em;                  // height of letters, pixels
  ColourScale scale;
  View view;
  Box frame;                  // pixels within which the scene is drawn
  Box drawn;                  // size of what grows with the scale: without symbols and labels
  Box room;                   // what title, legend, bar and the numbers of axes leave
  std::vector<std::array<Vec3, 2>> body_boxes;  // least and greatest reference corner of each body
  std::optional<Box> asked, window;  // what the figure shows, across and up, where that is not all: as the picture says; and drawn, which is at least that
  double window_strip = 0;    // pixels of the greatest pressure in a window
  double greatest_pressure = 0, greatest_shear = 0, greatest_load = 0;  // the first two of what is seen
  bool sharp = false;         // the greatest pressure is at an edge that presses
  bool deformation_shows = false;
  bool crowded = false;  // labels would take more room than they leave to the scene: they are within it
  Canvas under, over;         // below and above the bodies
  std::vector<Layer> layers;
  bool own_bar = true, own_legend = true;  // else they stand beside, for several scenes
  bool names_scale = true;                 // the legend names the deformation factor
  std::vector<LegendEntry> entries;        // of the legend
  std::optional<ScenePicture> inset;       // a small picture within this one
  std::vector<Painted> insets;             // as it is painted
  bool axes_of_bodies = false;  // plane: axes along the bodies, not all that stands around them

  double strip_height() const;                    // pixels of the greatest pressure, or shear
  // Pixels of an ordinate of the pressure and, where that is drawn as a strip or arrows, of an arrow of the shear, for one unit.
  double per_pressure() const;
  double longest_strip = INFINITY;                // units of length: longer ordinates would cross on concave parts
  bool pressures() const { return picture.pressure != PressureStyle::none; }
  // A map of a contact.
  bool map() const { return plane && !picture.contacts.empty() && picture.contacts.front().nodes_per_facet > 2; }
  // In space: a field is shown on the surfaces of contacts.
  bool colours_contacts() const { return !picture.contacts.empty() && !picture.contacts.front().values.empty(); }
  bool strips() const { return plane && pressures() && picture.pressure != PressureStyle::arrows; }  // else arrows
  // Where a contact's node, a support or a load is drawn: in space, and on the picture.
  template <class Thing>
  Vec3 place(const Thing& thing) const { return plus(thing.position, thing.displacement, picture.deformation); }
  // Is it on the side of the picture's cut that is drawn?
  template <class Thing>
  bool stays(const Thing& thing) const { return !picture.cut || picture.cut->beyond(place(thing)) <= 1e-9; }
  template <class Thing>
  Point at(const Thing& thing) const { return view.flat(place(thing)); }
  template <class Thing>
  std::vector<Point> at(const std::vector<Thing>& things) const {
    std::vector<Point> out;
    for (const Thing& thing : things) out.push_back(at(thing));
    return out;
  }
  // Says what has been drawn at these pixels; see door/marks.hpp.
  void tell(const std::string& what, std::span<const Point> at) {
    DataMark mark{what, {}};
    for (const Point& p : at) mark.at.push_back({(p.x - view.origin.x) / view.scale, (p.y - view.origin.y) / view.scale});
    over.tell(std::move(mark));
  }
  Point at(const BodyPicture& body, int node, double factor) const { return view.flat(body.node(node, factor)); }
  // In rendered pixels, `lift` pixels nearer to the eye.
  Vec3 rendered(const Vec3& pixel, double lift) const { return {factor * pixel[0], factor * pixel[1], factor * (pixel[2] + lift)}; }
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

// Numbers of places at least `spacing` pixels apart. Along an edge whose nodes
// are even: evenly and alike from both ends, where their number allows it up to these, else with
// equal steps all the same, as a gap would look like one of what is shown.
std::vector<std::size_t> spread(const std::vector<Point>& at, double spacing);
// The same of candidates, and always the one of the greatest value, with its mirror images about the middle of all.
std::vector<std::size_t> spread(const std::vector<Point>& at, const std::vector<std::size_t>& candidates, const std::function<double(std::size_t)>& value, double spacing);

// The same on a surface: `plan` are the places' coordinates across its normal.
// Where these are those of a grid, whole lines of it are left out.
std::vector<std::size_t> spread(const std::vector<Point>& at, const std::vector<Point>& plan, double spacing);

// Lays out, draws, and writes the file. The picture becomes higher where it lacks height. `prepare` is called for each stage that is made.
void draw_scene(const ScenePicture& picture, const std::function<void(Stage&)>& prepare = {});
// Its marks (door/marks.hpp).
std::vector<DataMark> read_scene(const ScenePicture& picture, const std::function<void(Stage&)>& prepare = {});
// Draws a stage that is laid out.
std::vector<Painted> painted(Stage& stage);

// Chooses the view and the frame, and reserves room for title, legend, axes
// and colour bar; draws these. Returns how many pixels the picture's height lacks for a scene and a colour bar that are legible;
// less than 0: so many it does not need.
double lay_out(Stage& stage);
// How many pixels wider the picture of a stage that is laid out must be, so that what stands beside the scene leaves it enough room; at most 0: it is wide enough.
double lacking_width(const Stage& stage);
// Throws InputError, which names the width needed, if a sheet lacks pixels. `remedy`: what else would help.
void refuse_narrow(const Sheet& sheet, double lacking, const std::string& remedy = "");

// Fits the picture's window into the room. The greatest pressure comes to a fifth of its height, less where it would not fit; from
// three quarters of that on the window grows. Sets stage.view, frame, window, and what depends on what is seen: greatest pressure,
// colours.
void fit_window(Stage& stage, const Box& room);

// Rigid obstacles: hatched on the solid side in the plane, surfaces in space.
Layer obstacle_layer();
// Its points; in the plane those of a line.
std::vector<Point> obstacle_line(const View& view, const RigidPicture& rigid);
// Surfaces, mesh edges and outlines of the bodies.
Layer body_layer();
// Whether bodies of the picture are displaced; by what factor, in words.
bool displaced(const ScenePicture& picture);
std::string scale_name(const ScenePicture& picture);
// The outline of a body in the plane, two nodes an edge.
std::vector<int> outline_edges(const BodyPicture& body);
// Leaves out what is beyond the picture's cut, of all that is in the renderer, and adds the faces of the cut.
void cut_bodies(const Stage& stage, vtkRenderer* renderer);
// Status, pressure and shear on the contact boundary.
Layer contact_layer();
// Lines of equal values, at the labelled ticks of the colour bar; labels only where `free` is true of their box.
void draw_isolines(Stage& stage, const std::function<bool(const Box&)>& free);
Layer isoline_layer();
// Trajectories of the principal stresses.
Layer trajectory_layer();
// Texts at points, framed parts.
Layer note_layer();
// Symbols of supports; arrows of loads.
Layer support_layer();
Layer load_layer();

// A small map of the contact that carries most in a scene in space: of its statuses, or of the field of contacts in the colours of the scene. draw_inset() draws it
// with its lower left pixel at `corner`.
std::optional<ScenePicture> inset_of(const ScenePicture& picture, const ColourScale& scale);
void draw_inset(Stage& stage, Point corner);
// A contact on its map; the hatching of a polygon that slips; the sample of a status in the map's legend.
void draw_contact_map(Stage& stage, const ContactPicture& contact);
void hatch_slip(Canvas& canvas, std::span<const Point> polygon, double em);
LegendEntry map_status_entry(const Stage& stage, Status status);
// Pixels of an arrow of the shear for one unit: as ordinates of the pressure where these are drawn, else the greatest `longest` em.
double shear_scale(const Stage& stage, double longest);
// Arrows of the shear at some of the nodes that rub, `spacing` apart; `arrow`: where a node's begins and ends.
std::vector<Segment> shear_arrows(const Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, double spacing,
                                  const std::function<Segment(std::size_t node)>& arrow);
// In the plane: where a node's arrow is, beside the contact line on the side of the first part, which it acts on; and those that are drawn.
Segment shear_arrow(const Stage& stage, const ContactNode& node);
std::vector<Segment> line_shear(const Stage& stage, const ContactPicture& contact);
void draw_shear(Stage& stage, const std::vector<Segment>& arrows);
// Of one contact in space: statuses and arrows of the pressure.
void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer);

// A text in a place that it shares with no other.
struct Label {
  std::string text;
  double size = 0;    // of the letters
  Box box;
  Colour colour;
  double ground = 0;  // pixels of pale ground around it; 0: a rim of white instead
  Point direction = {};  // outwards from what it explains
  std::optional<Point> tip = {};  // if it is far from the label, a thin line leads to it
};
// Those that do not overlap one before them.
void draw_labels(Canvas& canvas, const std::vector<Label>& labels);

// Of each contact the greatest pressure in words, beyond its ordinate and clear of
// outlines and obstacles; none where the contact carries (next to) nothing.
std::vector<std::optional<Label>> peak_labels(const Stage& stage, bool within_frame = true);
// The end of the pressure ordinate of a node.
Point pressure_tip(const Stage& stage, const ContactNode& node);

// Said of a pressure that has no bound: another mesh gives another number, and stresses there are means over cells.
constexpr const char* singular_edge = ", singular at an edge";

constexpr Colour pressure_line{45, 50, 90}, pressure_fill{205, 214, 235}, shear_line{150, 15, 40};
constexpr double hatch_depth = 0.75;  // em
// Surfaces that slip are hatched: the greys of stick and slip are nearly the same.
constexpr Colour slip_hatch{90, 55, 0};
constexpr double slip_spacing = 0.42, slip_line = 0.07, shear_head = 0.42;  // em

}  // namespace dotyk::figure
