#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/matching.hpp"
#include "contact/multipliers.hpp"
#include "contact/pairing.hpp"
#include "contact/rigid.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::scene {

/// What an interface does along its normal and its tangents. Numbers are per length or area; v along the normal is the gap as the bodies are deformed, v along the
/// tangents the slip of the first part, and the reaction on it pushes towards v > 0. With Signorini's normal law contact opens and closes.
struct InterfaceLaws {
  GivenLaw normal{problem::LawChoice{&problem::laws::signorini}};
  GivenLaw tangential{};
  InterfaceLaws() = default;
  InterfaceLaws(GivenLaw along) : tangential(std::move(along)) {}
  InterfaceLaws(GivenLaw across, GivenLaw along) : normal(std::move(across)), tangential(std::move(along)) {}
  InterfaceLaws(const problem::LawSpec& friction, elasticity::ScalarField value) : tangential(friction, std::move(value)) {}
};

/// The half cells of friction at the ends of a contact line: a cell each (m + 1 cells on m edges), joined to the next ones (m − 1), or without
/// friction, as TR965 (2.14) is printed (m − 1).
enum class CellEnds { own, joined, bare };

/// The multipliers of a contact. `friction_size`: see contact::friction_cells; it and `ends` (in the plane) for p1_p0 with friction only.
struct Discretisation {
  contact::Multipliers multipliers = contact::Multipliers::nodal;
  double friction_size = 0;
  CellEnds ends = CellEnds::own;
  bool share_fixed = true;  ///< false, for the study of (3.16): nodes that do not move, and corners, keep multipliers of their own
};

/// A pair of parts, or a part and a rigid shape, in contact or glued.
struct Contact {
  enum class Kind { contact, glue };
  Kind kind = Kind::contact;
  std::string name;  ///< "contact of 'block' top with a rigid gap"
  Part first;
  Part second;       ///< second.body is null against a rigid shape
  std::vector<contact::ContactRow> rows;   ///< of a contact
  problem::LawAlong normal{{&problem::laws::signorini}};  ///< by row; see InterfaceLaws
  problem::LawAlong tangential{};         ///< an infinite bound of friction: no slip
  Discretisation discretisation;
  contact::Pairing pairing = contact::Pairing::matching;  ///< of two parts
  bool turned = false;  ///< `first` and `second` are the parts in other order than they were given: see contact::pair_rows
  std::vector<contact::Tie> glued;         ///< of a glue
  contact::RigidShape shape;               ///< a gap function is not kept
  bool interference = false;               ///< an overlap at rest is meant
  double seconds = 0;                      ///< that finding the pairs took
  /// The contact that this one is another design of (its nodes moved), never one that is itself another's; null: of none.
  std::shared_ptr<const Contact> origin = nullptr;
};

/// Bodies and what joins them.
struct Scene {
  std::vector<std::shared_ptr<Body>> bodies;
  std::vector<std::shared_ptr<const Contact>> contacts;

  int dimension() const { return bodies.front()->dimension(); }
  /// Of a body of this scene, or of one that is another design of it; -1 for others and for null.
  int index_of(const Body* body) const;
  /// Of a contact, likewise.
  int index_of(const Contact& contact) const;
};

/// require_whole() of all bodies.
void require_whole(const Scene& scene, const std::string& what);

/// Throws InputError for no bodies, a body twice, two of one name, or mixed dimensions.
std::shared_ptr<Scene> make_scene(std::vector<std::shared_ptr<Body>> bodies);

/// Nodes stand for their share of the contact boundary, ∫φ: sets the rows' weights. What overhangs the other part has none.
void set_weights(Contact& contact);

/// The contact boundary of a contact.
contact::Surface surface_of(const Contact& contact);

/// Contact of two parts by the pairing asked for, else as their nodes are. Throws as contact::pair_rows, for a part whose body is not
/// in the scene, and for a friction value that is negative or not a number (an infinite bound of
/// given friction is allowed: the parts then do not slip at all), or for laws that an interface cannot have. Multipliers p1_p0 refuse Coulomb friction, laws
/// other than Signorini's and friction
/// (the bound is in the rows' weights, before the pressure is known), a bound infinite in places only, and nodes that
/// do not match. `monitor` may be null; throws Interrupted.
std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& first, const Part& second,
                                           const elasticity::ScalarField& added_gap, const InterfaceLaws& laws = {},
                                           bool interference = false, const Discretisation& discretisation = {},
                                           std::optional<contact::Pairing> pairing = {}, Monitor* monitor = nullptr);
/// Contact of a part with a rigid shape. Throws as contact::against, and for friction as above.
std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& part, const contact::RigidShape& shape,
                                           const elasticity::ScalarField& added_gap, bool interference,
                                           const InterfaceLaws& laws = {},
                                           const Discretisation& discretisation = {});
/// Ties two parts together: no jump of the displacement, at nodes of the first part or in the mortar mean. Throws as contact::pair_ties.
std::shared_ptr<const Contact> add_glue(Scene& scene, const Part& first, const Part& second,
                                        std::optional<contact::Pairing> pairing = {}, Monitor* monitor = nullptr);

/// What will be modelled, what is free to move, whether a solution exists, which method and why.
std::string plan(const Scene& scene);
/// A short report: bodies with sizes, supports, contacts.
std::string describe(const Scene& scene);

/// What is known of a scene's solutions before they are computed; with Coulomb friction also the factor of problem::uniqueness_factor(),
/// for which the scene is condensed: as long as a solve. Throws InputError where there is no solution, as solver::require_solvable.
struct UniquenessOfScene {
  bool exists = true, unique = false;
  std::optional<double> factor;
  std::string text;
};
UniquenessOfScene uniqueness(const Scene& scene, Monitor& monitor);

}  // namespace dotyk::scene
