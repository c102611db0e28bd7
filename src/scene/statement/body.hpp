#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "contact/matching.hpp"
#include "contact/sides.hpp"
#include "elasticity/assembly.hpp"
#include "elasticity/load.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"
#include "problem/law_choice.hpp"

namespace dotyk::scene {

/// Which part something was given to. Parts chosen by functions may share a name; their facets then differ.
struct PartMark {
  std::string name;
  std::size_t facets;  ///< a hash of them
  bool operator==(const PartMark&) const = default;
};

enum class SupportKind { fix, slide, displace };

/// A normal closer than this to an axis is taken as along it: a slide then eliminates the component.
inline constexpr double kAlongAxis = 1e-9;

/// Displacement components prescribed at nodes.
struct Support {
  SupportKind kind;
  PartMark part;
  std::vector<int> nodes;
  std::vector<std::array<bool, 3>> components;  ///< which are prescribed, one entry a node
  std::vector<mesh::Point> values;              ///< to what, one entry a node
  std::vector<mesh::Point> normals;             ///< outward, one entry a node
  std::string load_case = {};                   ///< of the values
  std::vector<mesh::Facet> facets = {};         ///< the part's
};

/// Bilateral sliding u·normal = 0 at a node whose normal is along no axis: a row of B.
struct SlideRow {
  PartMark part;
  int node;
  mesh::Point normal;  ///< unit, outward
  std::shared_ptr<const std::vector<mesh::Facet>> facets;  ///< the part's, one list for all its rows
};

/// A load per length or area on a part, kept as numbers where its points are: it stays with them if nodes move.
struct FacetLoad {
  PartMark part;
  std::string load_case;
  bool pressure;  ///< along the inward normal, wherever that turns; else a traction that keeps its direction
  std::vector<mesh::Facet> facets;
  std::vector<double> values;  ///< facet × quadrature point (elasticity::FacetPoint::index) × (pressure: 1, else dimension)

  /// Of one of the facets, at one of its points.
  mesh::Point traction(std::size_t facet, const elasticity::FacetPoint& point, int dimension) const;
  double pressure_at(std::size_t facet, const elasticity::FacetPoint& point) const;  ///< of a pressure
};

/// A load per volume, kept as numbers at the cells' points for loads.
struct VolumeLoad {
  int points = 0;     ///< of a cell
  bool uniform = true;
  std::shared_ptr<const std::vector<double>> values;  ///< cell × point (elasticity::CellPoint::index) × dimension, or of one point: uniform
  double factor = 1;  ///< of the values

  mesh::Point at(int cell, int point, int dimension) const;
};

/// A load's mean over a facet (force per length or area), drawn at the facet's centre.
struct LoadArrow {
  mesh::Facet facet;
  mesh::Point at;
  mesh::Point value;
};

/// Loads of one name, which the steps of a history scale apart from the others.
struct LoadCase {
  std::string name;
  std::vector<double> force;  ///< nodal loads, node × dimension; empty: none
};

struct SpringPatch {
  PartMark part;
  elasticity::FacetSpring spring;
};

/// A law as a statement gives it: the same everywhere, or a function of the place, asked at the nodes and not kept.
struct GivenLaw {
  problem::LawChoice law;
  std::function<problem::LawChoice(const mesh::Point&)> varies = nullptr;

  GivenLaw() = default;
  GivenLaw(problem::LawChoice same) : law(same) {}
  GivenLaw(const problem::LawSpec& spec, elasticity::ScalarField first) : varies([&spec, first](const mesh::Point& x) { return problem::LawChoice{&spec, {first(x)}}; }) {}
  /// Throws InputError where a number is not what the law allows, and for unlike laws.
  problem::LawAlong at(const std::vector<mesh::Point>& places, int dimension) const;
};

/// What laws do along the normal and the tangents of a part, at each of its nodes (one entry a node and adjoining
/// side) for that node's share of the boundary, ∫φ: forces are summed by the trapezoidal rule, as those of contact.
///
/// Normal: v = −u·n, n outward: positive away from the support, into the body; the reaction pushes towards v > 0.
/// Tangential, in the plane: v = u·t, t the normal turned by 90° anticlockwise (along x at the bottom of a block), and
/// the reaction along t. In space the vector of both tangents: elastic and friction (‖r‖ ≤ g, or μ times the normal law's pressure) are isotropic.
/// Loads and prescribed displacements are of no load case.
struct LawSupport {
  PartMark part;
  std::vector<mesh::Facet> facets;
  std::vector<contact::NodeSide> nodes;
  problem::LawAlong normal, tangential;  ///< by node
  std::vector<char> broken = {};  ///< of a breaking normal law: the nodes where it is; empty: none
  bool breaks(std::size_t node) const { return node < broken.size() && broken[node]; }
};

/// Where the ranks refine a body's mesh: what it was before.
struct Unrefined {
  std::shared_ptr<const mesh::Mesh> mesh;
  elasticity::MaterialField material;
  elasticity::LinearForce force;  ///< per volume
  int times;
  std::vector<std::vector<double>> between;  ///< as elasticity::NearBoundary
};

/// An elastic body with its supports and loads. All fields are evaluated as they are given:
/// a body holds numbers only.
struct Body {
  std::string name;
  std::shared_ptr<const mesh::Mesh> mesh;
  elasticity::MaterialField material;
  std::shared_ptr<const Unrefined> unrefined;  ///< where `mesh` has the cells near the boundary alone; null: it is whole
  std::vector<Support> supports;
  std::vector<SlideRow> slides;
  std::vector<SpringPatch> springs;
  std::vector<LawSupport> laws;
  std::optional<VolumeLoad> volume_load;  ///< of no case
  std::vector<FacetLoad> facet_loads;
  /// Nodal loads of no case, node × dimension: the sums of what these loads give (see sum_loads); empty: none. Where ranks refine the body the
  /// load per volume is not in it: they assemble that load themselves.
  std::vector<double> force;
  double force_at(std::size_t component) const { return force.empty() ? 0 : force[component]; }
  std::vector<LoadCase> cases;
  /// The body that this one is another design of (its nodes moved), never one that is itself another's; null: of none.
  std::shared_ptr<const Body> origin;

  int dimension() const { return mesh->dimension(); }
  /// How many nodes and cells the whole mesh has.
  int node_count() const { return mesh->whole ? mesh->whole->nodes.front() : mesh->node_count(); }
  std::int64_t cell_count() const { return mesh->whole ? mesh->whole->cells : mesh->cell_count(); }
  /// Components of nodes that only the ranks have.
  int hidden_components() const { return dimension() * (node_count() - mesh->node_count()); }
  std::vector<elasticity::FacetSpring> facet_springs() const;
};

/// Some boundary facets of a body.
struct Part {
  std::shared_ptr<Body> body;
  std::string name;
  std::vector<mesh::Facet> facets;
  /// "'block' top", for messages.
  std::string label() const { return "'" + body->name + "' " + name; }
  contact::Face face() const { return {*body->mesh, facets, label()}; }
  PartMark mark() const;
};

/// A body of this mesh and material; the mesh is checked (see mesh::check) and must be in one piece, connected
/// through facets. `force` per volume, may be empty.
std::shared_ptr<Body> make_body(std::string name, std::shared_ptr<const mesh::Mesh> mesh,
                                elasticity::MaterialField material,
                                const elasticity::VectorField& force);

/// A body whose mesh is `mesh` refined `times` ≥ 1 times; `material` is given for the cells of `mesh`, and `force` is taken to be linear in each of them. On one rank the body has the whole refined mesh. On several
/// ranks they refine it when it is solved, and the body has the cells near the boundary.
std::shared_ptr<Body> make_refined_body(std::string name, std::shared_ptr<const mesh::Mesh> mesh, elasticity::MaterialField material, int times,
                                        const elasticity::VectorField& force, Monitor& monitor);

/// Throws InputError where the body's inner cells are with the ranks. `what` needs them: "an error estimate".
void require_whole(const Body& body, const std::string& what);

/// Names of the parts that the body's mesh brings.
std::vector<std::string> part_names(const Body& body);
/// A part that the mesh brings. Throws InputError if there is none of that name or it has no facets.
Part named_part(const std::shared_ptr<Body>& body, const std::string& name);
/// The boundary facets that `chosen(centre, outward normal)` accepts. Throws InputError if there are none.
Part chosen_part(const std::shared_ptr<Body>& body, const std::string& name,
                 const std::function<bool(const mesh::Point&, const mesh::Point&)>& chosen);

/// Numbers the body's free components. Throws InputError where supports contradict each other at a
/// node, naming both parts.
elasticity::Numbering number(const Body& body);
/// Changes what holds a body. Throws InputError, and leaves the body as it was, where supports then contradict each other.
void hold(Body& body, const std::function<void(Body&)>& change);

/// Zero displacement of the components flagged. This and the next two throw as hold().
void fix(Part& part, const std::array<bool, 3>& components);
/// Bilateral contact without friction: u·n = 0 on the part; at an edge between two of its sides, for both normals.
void slide(Part& part);
/// Prescribes the components given; a component left empty stays free.
void displace(Part& part, const std::array<elasticity::ScalarField, 3>& components, const std::string& load_case = {});

/// Force per volume, of no case; a body takes one.
void load_volume(Body& body, const elasticity::CellField& force);
void load_volume(Body& body, const elasticity::VectorField& force);
/// Force per length (2-D) or area (3-D).
void load(Part& part, const elasticity::VectorField& traction, const std::string& load_case = {});
/// Positive along the inward normal.
void pressure(Part& part, const elasticity::ScalarField& value, const std::string& load_case = {});
/// The nodal loads of a case, zeros where there were none.
std::vector<double>& nodal_loads(Body& body, const std::string& load_case = {});
/// What the load per volume gives on the body's mesh, node × dimension; empty: there is none.
std::vector<double> volume_forces(const Body& body);
/// Sums the nodal loads of all cases anew from the body's loads, on its mesh as it is.
void sum_loads(Body& body);
/// The loads on parts, those of each facet together.
std::vector<LoadArrow> load_arrows(const Body& body);
/// The load per volume at each cell: its points' mean; empty: none.
std::vector<mesh::Point> cell_forces(const Body& body);

/// Elastic support per length or area; a component left empty has none. Throws InputError where negative.
void spring(Part& part, const std::array<elasticity::ScalarField, 3>& stiffness);

/// Support laws on a part, numbers per length (2-D) or area (3-D); those of kind `free` are not given. A
/// second call on the same part may give the law that the first left free. Throws InputError, leaving the body as it
/// was, where Coulomb friction has no normal law, a number is negative or not finite, a tangential law has no meaning (one-sided; in space also a load, a
/// displacement other than 0 and capped elastic), a facet of the part has a law in that direction already, or
/// other supports hold that direction at all nodes of the part.
void support(Part& part, const GivenLaw& normal, const GivenLaw& tangential);
/// Throws InputError where a law cannot be tangential: one that tells directions, and in space what is not isotropic.
void require_tangential(const problem::LawAlong& law, int dimension);
/// Throws InputError where a law cannot be normal.
void require_normal(const problem::LawAlong& law);
/// Throws InputError where supports hold a direction, normal or tangential, that a law of the body is about, at all
/// nodes of its part.
void require_laws_free(const Body& body, const elasticity::Numbering& numbering);
/// "normal elastic 100; tangential friction 2".
std::string describe(const LawSupport& support);
/// Sides of a law's part with a normal's components that are rounding made 0: no unknown may hang on them.
std::vector<contact::NodeSide> law_sides(std::vector<contact::NodeSide> sides);
/// Has one of the nodes an unknown along the direction?
bool unknown_along(const elasticity::Numbering& numbering, const std::vector<contact::NodeWeight>& nodes, const mesh::Point& direction, int dimension);
/// Does one of the side's own nodes move along the direction? Not along what a slide on no axis holds.
bool moves(const Body& body, const elasticity::Numbering& numbering, const contact::NodeSide& side, const mesh::Point& direction);

}  // namespace dotyk::scene
