// What a picture shows, as plain data: no VTK, no Eigen, nothing to link but
// dotyk_figure. Fill a ScenePicture or a ChartPicture and call draw().
//
// Conventions. Coordinates come three per node (z = 0 in the plane), in the
// user's length unit. Displacements are unscaled; the drawing multiplies them
// by ScenePicture::deformation. Normals are outward unit vectors. Pressure is
// positive in compression. Node numbers count from 0. Texts are UTF-8.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace dotyk::figure {

using Vec3 = std::array<double, 3>;

constexpr int least_side = 160, greatest_side = 8192;           // pixels of a picture
constexpr double least_printed = 30, greatest_printed = 500;    // mm, widths on paper

// The file that a picture becomes, and what stands above it.
struct Sheet {
  std::string file;                         // ends in .png, .pdf or .svg; its folder must exist
  int width = 1000, height = 900;           // pixels, 160 to 8192 each; of PDF and SVG the proportions
  std::string title;                        // empty: none, the space goes to the picture
  std::optional<double> printed = {};       // width on paper in mm, 30 to 500, for which letters are made; default: one column of a journal, 85, or two, 178
};

// ---------------------------------------------------------------- colours

// Contact status of a node, named as in s:contact(c).nodes[i].status.
enum class Status { open, closed, stick, slip };

struct Colour {
  unsigned char r = 0, g = 0, b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

// "open", "closed", "stick" or "slip".
const char* status_name(Status status);

// The Okabe-Ito colour of a status: told apart with every common colour
// blindness, and apart from the colour maps of fields.
Colour status_colour(Status status);

// Colour of the k-th series of a chart; repeats after seven, markers do not
// repeat in step.
Colour series_colour(int k);

// ----------------------------------------------------------------- scenes

enum class CellShape { triangle, quad, tetrahedron, hexahedron };

inline int nodes_per_cell(CellShape shape, int order) {
  static constexpr int nodes[][2] = {{3, 6}, {4, 9}, {4, 10}, {8, 27}};
  return nodes[static_cast<int>(shape)][order - 1];
}

// One body. Cells of higher order are given by their corner nodes, or cut
// into corner cells by the caller (a P2 triangle into four).
struct BodyPicture {
  std::string name;
  int dimension = 2;                        // 2 or 3
  CellShape shape = CellShape::triangle;
  std::vector<double> points;               // 3 n: reference coordinates
  std::vector<double> displacement;         // 3 n, or empty: not displaced
  std::vector<int> cells;                   // nodes of the cells, 3, 4, 4 or 8 each, VTK order; in space they are not drawn
  std::vector<double> values;               // n: the field at the nodes, or empty: plain colour
  std::vector<double> cell_values;          // one for each cell, in place of `values`; or empty
  std::vector<double> stress;               // plane, 3 n: xx yy xy, for trajectories; or empty
  std::vector<int> facets;                  // nodes of the boundary facets, flat; empty in the plane: edges of one cell only
  std::vector<int> facet_cells;             // space, where there are cell_values: of each facet its cell
  int nodes_per_facet = 2;                  // 2 in the plane, 3 or 4 in space
  std::vector<int> edges;                   // mesh lines, two nodes each; empty: the edges of the cells

  // Node i, displaced by `factor` times its displacement.
  Vec3 node(std::size_t i, double factor) const {
    Vec3 p{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
    for (std::size_t c = 0; c < 3 && !displacement.empty(); ++c) p[c] += factor * displacement[3 * i + c];
    return p;
  }
};

// A rigid obstacle, drawn in neutral grey, where its points are: they are not displaced.
struct RigidPicture {
  std::vector<double> points;               // 3 n: in the plane the vertices of a polyline, in order
  std::vector<int> triangles;               // in space: 3 nodes a triangle; in the plane empty
  Vec3 into_solid = {0, -1, 0};             // plane: the side that is hatched
};

struct ContactNode {
  Vec3 position = {0, 0, 0};                // reference coordinates on the first part
  Vec3 displacement = {0, 0, 0};            // of the first part there
  Vec3 normal = {0, 1, 0};                  // outward normal of the first part
  double pressure = 0;                      // force per length (plane) or area (space)
  double weight = 0;                        // length or area the node stands for; 0: unknown
  Status status = Status::open;
  Vec3 shear = {0, 0, 0};                   // friction on the first part, as the pressure
  double rest_gap = 0;                      // to another body at rest, along the normal; negative: an interference
  double gap = 0, slip = 0;                 // as deformed; how far it has slipped
  bool sharp = false;                       // the part ends here within a smooth face: an edge presses, and the pressure has no bound
  bool covered = false;                     // another contact on the same part tells the state of this node: neither marker nor line
};

// One contact: its nodes on the first part, and how they hang together. In the plane facets of 3 or 4 nodes are those of a map
// (contact_map.hpp).
struct ContactPicture {
  std::string name;
  std::vector<ContactNode> nodes;
  std::vector<int> facets;                  // positions in `nodes`, flat; may be empty: markers only
  int nodes_per_facet = 2;                  // 2 in the plane, 3 or 4 in space
  std::vector<double> values;               // space, n: a field on the surface, or empty: it shows the statuses
  bool apart = false;                       // space: drawn off the other body, seen from outside of its own alone
};

enum class SupportKind { fix, slide, displace, spring };  // the first ones as scene::SupportKind has them

// A symbol at a supported boundary node or facet centre. Give one per node:
// the drawing leaves out those that would overlap.
struct SupportSymbol {
  Vec3 position = {0, 0, 0};
  Vec3 displacement = {0, 0, 0};            // of the body there, unscaled
  Vec3 normal = {0, 1, 0};                  // outward normal of the body; the symbol stands outside
  std::array<bool, 3> fixed = {true, true, true};  // components held (fix, displace, spring)
  SupportKind kind = SupportKind::fix;
  bool open = false;                        // it does not act: it stays where it is at rest, in the colour of "open"
  int place = 0;                            // in the plane, number along the outlines of bodies: of neighbours at most 2 apart
};

// A text at a point of a scene.
struct Note {
  Vec3 position = {0, 0, 0};                // as drawn: deformed
  std::string text;
};

// A plane, and the side of it that is left out: the one that the normal points to.
struct Cut {
  Vec3 point = {0, 0, 0}, normal = {0, -1, 0};
  // How far on the side that is left out.
  double beyond(const Vec3& p) const { return (p[0] - point[0]) * normal[0] + (p[1] - point[1]) * normal[1] + (p[2] - point[2]) * normal[2]; }
};

// A load arrow; lengths are scaled so that the greatest one is readable.
struct LoadArrow {
  Vec3 position = {0, 0, 0};
  Vec3 displacement = {0, 0, 0};
  Vec3 vector = {0, 0, 0};                  // force, or force per length or area
  Vec3 normal = {0, 0, 0};                  // outward normal of the body there
  int place = 0;                            // as of a support
};

enum class MeshEdges { automatic, on, off };           // automatic: while they can be told apart
enum class PressureStyle { automatic, strip, arrows, none };  // automatic: strip in the plane, arrows in space

// In the plane: equal axes with ticks, contact drawn on the boundary in the
// colours of its statuses. In space: parallel projection, z upwards; open
// parts of a contact are outlined, others filled, and a plan of the contact
// that carries most, seen along its normal, stands beside the scene.
struct ScenePicture : Sheet {
  ScenePicture() : Sheet{{}, 1200, 800, {}} {}
  std::string caption;                      // empty: none; the deformation factor is stated in any case

  std::string field_label;                  // "von Mises stress"; empty: no colour bar
  std::string field_unit;                   // "MPa"; may be empty
  bool field_signed = false;                // its sign has a meaning, as a stress component's: colours diverge about zero
  std::optional<std::array<double, 2>> field_range;  // {least, greatest}; values beyond keep the end colour, a triangle on the bar tells of them

  double deformation = 1;                   // factor on every displacement
  bool gaps_magnified = false;              // obstacles are drawn where that factor on their gaps at rest has put them, too
  // Plane: only this region, {x0, y0, x1, y1} in the coordinates of the deformed
  // picture, larger; colours and pressures are then scaled to what is seen. It
  // grows where the drawing of the pressure would not fit into it.
  std::optional<std::array<double, 4>> window;
  std::optional<std::array<double, 6>> region;  // space: likewise, {x0, y0, z0, x1, y1, z1}
  std::vector<std::array<double, 4>> marked;    // plane: framed boxes
  std::optional<Cut> cut;                       // space, in the coordinates of the deformed picture
  std::vector<Note> notes;
  bool isolines = false;                        // plane: of the field, at the ticks of its bar
  bool trajectories = false;                    // plane: of the principal stresses, the greater ones full, the lesser dashed
  std::vector<BodyPicture> bodies;          // all of one dimension
  std::vector<RigidPicture> obstacles;
  std::vector<ContactPicture> contacts;
  std::vector<SupportSymbol> supports;
  std::vector<LoadArrow> loads;

  // Pressure, shear and load for which the longest ordinates and arrows stand; 0: the greatest of what is seen.
  std::array<double, 3> longest = {0, 0, 0};
  std::string length_unit, pressure_unit, load_unit;  // of the axes; of pressure and shear; of loads; may be empty
  bool shear = true;                        // arrows of the shear, where there is any
  PressureStyle pressure = PressureStyle::automatic;
  MeshEdges edges = MeshEdges::automatic;
  bool inset = true;                        // space: a map of the contact that carries most beside the scene
  bool axes = true;                         // plane: ticks with coordinates; space: a triad
  std::array<std::string, 2> axis_names = {"x", "y"};  // plane
  std::optional<Vec3> view_from;            // space: direction towards the eye; default: sees the contact side
};

// Scenes row by row on one sheet, with one legend, and one colour bar where they show the same field. Files and sizes of the panels
// are not looked at.
struct SceneGrid : Sheet {
  int columns = 1;
  std::vector<ScenePicture> panels;
};

// ----------------------------------------------------------------- charts

enum class SeriesStyle { line, points, both };

struct SeriesPicture {
  std::string name;                         // empty: not in the legend
  std::vector<double> x, y;                 // n each, see `crossed`; points that are not finite (or not positive on a log axis) are gaps
  SeriesStyle style = SeriesStyle::both;
  std::vector<double> low, high;            // n each or empty: a spread about y, drawn as a band
  bool bars = false;                        // that spread as upright whiskers instead
  bool reference = false;                   // a reference curve: dashed, dark grey, no markers
  std::vector<double> x_low, x_high;        // n each or empty: a spread about x, drawn as whiskers
  // Markers pale and crossed out: runs that failed. Where these have no ordinate y is empty: they stand in a strip above
  // the plot, beyond a break of the y axis; each such series in a row of its own, the first lowest.
  bool crossed = false;
  bool front = false;                       // a broad pale line beneath everything, no markers
  bool twin = false;                        // dashed, with colour and marker of the series before it
  std::optional<Status> status;             // in the colour and with the marker that contact nodes of this status have
  bool right = false;                       // on the y axis on the right
  std::optional<int> place;                 // of its colour and marker, from 0; default: in the order of the series, or of known methods
};

// A guide of the given slope. With both axes logarithmic y ~ x^slope;
// otherwise y ~ slope x. Drawn as a small triangle clear of the curves.
struct SlopeGuide {
  double slope = 1;
  std::string label;                        // empty: the slope itself
};

// A text at a free place near a point, which a thin line leads to.
struct ChartNote {
  double x = 0, y = 0;
  std::string text;
};

// A value at each of a grid's points: cells around these, in colours beneath the series.
struct ChartMap {
  std::vector<double> x, y;                 // ascending; borders of cells are halfway between, on a logarithmic axis of the logarithms
  std::vector<double> values;               // at (x_i, y_j): values[j · n_x + i]; nan: not applicable, white with a cross
  std::string label, unit;                  // of the colour bar
  std::optional<std::array<double, 2>> range;  // of the colours; default: the values', of panels those of all maps with this label
  std::vector<std::string> names;           // not empty: values count these from 1, each has a colour and stands in the legend
};
constexpr std::size_t most_map_names = 6;   // as many colours differ in grey too

struct ChartPicture : Sheet {
  ChartPicture() : Sheet{{}, 1000, 750, {}} {}
  std::string x_label, y_label;             // with their units
  std::string y_right_label;                // of the series that are on the right; that axis is logarithmic where the left one is
  bool log_x = false, log_y = false;
  std::vector<SeriesPicture> series;        // of several reference curves with names each has its name beside it
  std::string strip_label = "not converged";
  std::optional<ChartMap> map;
  std::vector<ChartNote> notes;
  std::vector<std::string> categories;      // names of x = 1, 2, …
  std::optional<std::array<double, 2>> y_break;  // the linear y axis leaves out what lies between
  bool polar = false;                       // x: angles in degrees, anticlockwise from the right; y: radii
  std::vector<SlopeGuide> slopes;
  // Default: the data with a margin. One range given to both linear axes of a chart of its own: a
  // square plot, so that a circle is round.
  std::optional<std::array<double, 2>> x_range, y_range;
};

// Charts one below the other, or row by row in several columns. The panels' files and sizes are not looked at.
struct ChartColumn : Sheet {
  bool shared_x = false;                    // one x axis, named below the last panel; all or none logarithmic
  int columns = 1;
  std::vector<ChartPicture> panels;         // from above, within a row from the left
};

// ------------------------------------------------------ files for ParaView

// Values at every node, one tuple a node.
struct GridArray {
  std::string name;
  std::vector<std::string> components;  // their names, one or more; names of one are not written
  std::vector<double> values;           // components × n, node by node; nan where there is none
};

// The cells of one body, as node numbers of the whole file.
struct GridBody {
  std::string name;
  CellShape shape = CellShape::triangle;
  std::vector<int> cells;               // 3, 4, 4 or 8 nodes each, of order 2 6, 9, 10 or 27; VTK order
  int order = 1;
};

struct GridFile {
  std::string file;                     // ends in .vtu or .pvtu; its folder must exist
  std::vector<double> points;           // 3 n: reference coordinates, of all bodies
  std::vector<GridBody> bodies;
  std::vector<GridArray> arrays;
  int pieces = 0;                       // of a .pvtu; 0: one for each million cells
  std::vector<std::string> written = {};  // of a .pvtu, files that are there already: it lists them, and its arrays need no values
};

// ---------------------------------------------------------------- drawing

// Draws the picture and writes it, whole or not at all: on an error
// picture.file is as it was. Equal pictures give equal bytes.
// Throws std::runtime_error: the folder does not exist or cannot be written
// (path and reason), arrays of unequal or impossible length (which), a node
// number out of range, a size out of range, the drawing library not found.
void draw(const ScenePicture& picture);
void draw(const SceneGrid& grid);
void draw(const ChartPicture& picture);
void draw(const ChartColumn& picture);

// Writes VTK's XML format, the numbers compressed in binary, whole or not at
// all: on an error grid.file is as it was. Cells carry the array "body": their
// body's place in `bodies`, from 1; the text array "body_names" has the names.
// The file a.pvtu is a list of the files a_0.vtu, a_1.vtu, … in its folder. Each
// of them has a part of every body's cells, and the nodes of these cells. An old
// list is removed first and the new one is written last, so that a list never
// names files of two calls; on an error there is no list.
// Throws std::runtime_error as draw() does.
void write(const GridFile& grid);

}  // namespace dotyk::figure
