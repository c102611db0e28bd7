// From a solution to what its picture shows.
#pragma once

#include <optional>
#include <string>

#include "figure/door/picture.hpp"
#include "multigrid/slices.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::figure {

// The last four are of contacts, on their surfaces in space and on maps.
enum class FieldChoice { none, displacement, ux, uy, uz, von_mises, xx, yy, zz, yz, xz, xy, error, pressure, gap, slip, status };

inline bool of_contacts(FieldChoice field) { return field >= FieldChoice::pressure; }

// As scripts call them, in the order of the choices.
const std::vector<std::pair<const char*, FieldChoice>>& field_names();

struct SceneOptions {
  FieldChoice field = FieldChoice::von_mises;
  std::optional<double> deform;  // factor; empty: chosen so that the deformation can be seen
  bool contact = true;           // status on the contact boundary, pressure, and the obstacle in the plane
  bool obstacle = true;          // rigid obstacles (in space only where asked: they hide the contact)
  bool supports = false;
  bool loads = false;
  bool trajectories = false;     // of the principal stresses, in the plane
  double explode = 0;            // in space: bodies move from the middle of the scene by this share of their distance to it
};

// Units by name; empty ones are not written.
struct SceneUnits {
  std::string length, stress, load;
};

// Fills bodies, contacts, obstacles, symbols, the field with its label, and the
// deformation factor. File, size, titles and styles are the caller's. Where
// rigid obstacles are drawn: see obstacle_picture(). Throws InputError for a
// field that the dimension does not have.
ScenePicture compose(const scene::Solution& solution, const SceneOptions& options);

// The map of a contact in space, see contact_map.hpp, with one of its fields. Throws InputError for another field, and in the plane.
ScenePicture compose_map(const scene::Solution& solution, const scene::Contact& contact, FieldChoice field);

// Writes the units into a picture that shows this field.
void name_units(ScenePicture& picture, FieldChoice field, const SceneUnits& units);

// Its cells look as their corners do.
CellShape cell_shape(const mesh::Mesh& mesh);

// For ParaView: all bodies of the scene at rest, one after the other, with node arrays
//   displacement      3 components
//   stress            recovered, 6 components in VTK's order xx yy zz xy yz xz
//   von_mises
//   contact_pressure  positive in compression, 0 off the contact boundary
//   contact_gap       after deformation, positive when open; nan where there is no contact
//   contact_status    0 open, 1 closed, 2 stick, 3 slip; -1 where there is no contact
// Of order 2 the contact's fields are linear (bilinear) between the corners of facets, and the arrays have their values at the
// nodes there, too; the status is that of the corner with the greatest pressure. The contact arrays are left out where the scene has no contact. Of several conditions at one node (a
// corner, two contacts) the one with the greatest pressure is shown, else that with the least gap.
GridFile compose_grid(const scene::Solution& solution, const std::string& file);

// The first three of these arrays, node by node.
class NodeArrays {
 public:
  void add(const Vec3& displacement, const elasticity::Stress& stress);
  std::vector<GridArray> all() && { return {std::move(displacement_), std::move(stress_), std::move(von_mises_)}; }

 private:
  GridArray displacement_{"displacement", {"x", "y", "z"}, {}}, stress_{"stress", {"xx", "yy", "zz", "xy", "yz", "xz"}, {}}, von_mises_{"von_mises", {""}, {}};
};
// The others: of a solution, empty where the scene has no contact; as they are at so many nodes where there is none.
std::vector<GridArray> contact_arrays(const scene::Solution& solution);
std::vector<GridArray> contact_arrays(std::size_t nodes);

// 1, 2 or 5 times a power of ten, at least 1, such that the greatest displacement comes to 4 to
// 10 % of the scene's size; less where bodies that crossed a gap would be drawn into each other, or
// those that an interference presses apart from each other.
double visible_deformation(const scene::Solution& solution);

// `displacement`: of the first body.
ContactPicture contact_picture(const scene::Contact& contact, const scene::ContactResult& result, const std::vector<double>& displacement);

// At each node; of open nodes the slip is NaN, which is drawn grey. Of `status` none.
std::vector<double> contact_values(const ContactPicture& contact, FieldChoice field);

// The contacts of a scene of this size, on both bodies where these are drawn apart, moved by `moves`; and their obstacles.
void add_contacts(const scene::Solution& solution, const SceneOptions& options, const std::vector<Vec3>& moves, double size, ScenePicture& picture);

// The obstacle of a contact with a rigid shape, for bodies drawn at x + m u (m is `factor`). The motion d of the shape
// (`move`) and the gap g₀ at rest are magnified as displacements are; but a plane stays one where the part is far from
// it: of g₀ at most c = max(0, greatest w·n) is magnified, as far as some node has come towards it. Here w = u − d is a
// node's displacement relative to the obstacle and n the direction towards that; for other shapes c = ∞. The obstacle
// passes through
//   x + g₀ n + m d + (m − 1)(w_t + min(g₀, c) n),
// without w_t where no node is closed: then it does not follow the body. At m = 1 this is where the obstacle is. A closed
// node (w·n = g₀) lies on it at any m ≥ 1, but for its way w_t along it; an open one stands off it by between its gap and
// m times its gap.
// Left out are nodes that do not face the obstacle, and those that would stand off it by a quarter of the scene's `size`.
// In the plane a half-space, which ends nowhere, is drawn a little beyond the contact.
RigidPicture obstacle_picture(const scene::Contact& contact, const scene::ContactResult& result, const Vec3& move, double factor,
                              double size);

/// Writes a.pvtu and the files a_0.vtu, a_1.vtu, … of the ranks, with the arrays of compose_grid(). Throws as write() for a GridFile, and InputError where
/// a rank cannot write.
void write_pieces(const scene::Solution& solution, const std::string& file);

/// What a rank makes of its cells for that.
Lists write_cells(const multigrid::VisitedCells& at, const Lists& said);

}  // namespace dotyk::figure
