#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "problem/condensed.hpp"
#include "problem/problem.hpp"
#include "scene/statement/loading.hpp"

namespace dotyk::scene {

/// A cell of friction and its tangential rows: one in the plane, up to two in space (fewer where supports hold a
/// direction on both sides).
struct FrictionRows {
  contact::FrictionCell cell;
  int count = 0;
  int row[2] = {-1, -1};
  mesh::Point direction[2] = {};  ///< in space: unit, perpendicular to the cell's mean normal
  /// The direction of row i at one of the cell's contact rows: perpendicular to its normal.
  mesh::Point at(int i, const contact::ContactRow& row, int dimension) const;
};

/// The rows of B of a support's laws at one node of its part, -1 or fewer where other supports hold a direction.
struct SupportRows {
  int normal = -1;
  int count = 0;  ///< tangential ones
  int row[2] = {-1, -1};
  mesh::Point direction[2] = {};
  void add(int r, const mesh::Point& tangent) {
    row[count] = r;
    direction[count++] = tangent;
  }
};

/// What a row of B measures at a component whose displacement is prescribed; B itself is of the unknowns.
struct HeldEntry {
  int row, body;
  std::size_t component;  ///< node × dimension
  double value;
};

/// Where the rows of a scene's problem come from.
struct SceneRows {
  /// The scene's, their normals as the supports say: see with_held_normals(). Results and rows are by these.
  std::vector<std::shared_ptr<const Contact>> contacts;
  /// Contact → its row → row of B of the normal multiplier there, or -1 where no unknown moves it (both sides fixed).
  std::vector<std::vector<int>> contact_row;
  std::vector<std::vector<contact::NormalRow>> normal;  ///< contact → its row → what that row of B measures
  std::vector<std::vector<FrictionRows>> friction;      ///< contact → its cells
  std::vector<std::vector<int>> slide_row;       ///< body → its SlideRow → row of B, or -1
  std::vector<std::vector<std::vector<SupportRows>>> support_row;  ///< body → its LawSupport → its nodes
  std::vector<mesh::Point> move;                 ///< contact → displacement of its rigid shape
  std::vector<HeldEntry> held;                   ///< of all rows
};

/// A scene as a problem, and the way back.
struct Model : SceneRows {
  problem::Problem problem;
  std::vector<Body> bodies;                      ///< as they were: a script may add supports and loads later; scaled
  std::vector<elasticity::Numbering> numbering;  ///< one a body
  /// Body → are its springs rows? They are where a motion is held by hardly anything else: K then has that motion in its kernel, and what holds the body,
  /// contact among it, is not lost in rounding beside K.
  std::vector<char> springs_are_rows;
  /// The springs that K has.
  std::vector<elasticity::FacetSpring> springs_in_stiffness(std::size_t body) const;
  std::optional<problem::Decomposition> decomposition;  ///< by which problem.subdomains were cut; none: they were not

  /// Body → rigid motions that its supports hardly hold, with what they are and how stiff: "nearly free:
  /// rotation about (0, 0); without contact held only by fix of left (2 nodes), 3e-08 as stiff as the body". Mostly empty.
  std::vector<std::string> nearly_free;
  double softest = 1;  ///< how stiff K holds the softest of these motions, relative to its body

  /// A body's displacement, node × dimension, from the unknowns of all blocks.
  std::vector<double> displacement(int body, const algebra::Vector& u) const;
  /// The force that a contact's multipliers exert on its first body, at the node of each contact row (the
  /// opposite one acts on the partner).
  std::vector<mesh::Point> contact_force(int contact, const algebra::Vector& lambda) const;
};

/// The values of a body's unknowns at all its components, node × dimension; `rest` at the others.
std::vector<double> spread(const elasticity::Numbering& numbering, const algebra::Vector& x, std::vector<double> rest);

/// Assembles. Throws InputError for contradictory supports, for a contact that nodes fixed on both sides
/// make impossible, for a body whose supports are lost in rounding beside its stiffness, and, with rows or subdomains, as
/// problem::require_moderate(). Adds its time to clock.assembly. With a `decomposition` the bodies are also cut into subdomains by it: see cut().
/// `slices` decides whether K may be in slices: each rank assembles its own rows. It is asked when everything except K and f is known. Empty: they may not.
Model build(const Scene& scene, problem::Clock& clock, Monitor& monitor, const Loading& loading = {},
            const std::optional<problem::Decomposition>& decomposition = {}, const std::function<bool(const problem::Problem&)>& slices = {});
/// "'b1' is nearly free: …" of the first three such bodies, and how many more there are.
std::vector<std::string> describe_nearly_free(const Scene& scene, const Model& model);
/// Puts another loading on a model: f (of subdomains, too) and c change, K and B stay. `bodies`: the scene's, unscaled, as
/// when it was built. Throws as build.
void reload(const Scene& scene, const std::vector<Body>& bodies, const Loading& loading, Model& model,
            problem::Clock& clock);

}  // namespace dotyk::scene
