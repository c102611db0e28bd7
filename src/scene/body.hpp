#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elasticity/assembly.hpp"
#include "elasticity/load.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::scene {

/// Which part something was given to. Parts chosen by functions may share a name; their facets then differ.
struct PartMark {
  std::string name;
  std::size_t facets;  ///< a hash of them
  bool operator==(const PartMark&) const = default;
};

enum class SupportKind { fix, slide, displace };

/// Displacement components prescribed at nodes.
struct Support {
  SupportKind kind;
  PartMark part;
  std::vector<int> nodes;
  std::vector<std::array<bool, 3>> components;  ///< which are prescribed, one entry a node
  std::vector<mesh::Point> values;              ///< to what, one entry a node
  std::vector<mesh::Point> normals;             ///< outward, one entry a node
  std::string load_case = {};                   ///< of the values
};

/// Bilateral sliding u·normal = 0 at a node whose normal is along no axis: a row of B.
struct SlideRow {
  PartMark part;
  int node;
  mesh::Point normal;  ///< unit, outward
};

/// A load as drawn: its value at a facet's centre (force per length or area).
struct LoadArrow {
  PartMark part;
  mesh::Point at;
  mesh::Point value;
  std::string load_case = {};
};

/// Loads of one name, which the steps of a history scale apart from the others.
struct LoadCase {
  std::string name;
  std::vector<double> force;  ///< nodal loads, node × dimension
};

struct SpringPatch {
  PartMark part;
  elasticity::FacetSpring spring;
};

/// An elastic body with its supports and loads. All fields are evaluated as they are given:
/// a body holds numbers only.
struct Body {
  std::string name;
  std::shared_ptr<const mesh::Mesh> mesh;
  elasticity::MaterialField material;
  std::vector<Support> supports;
  std::vector<SlideRow> slides;
  std::vector<SpringPatch> springs;
  std::vector<double> force;  ///< nodal loads of no case, node × dimension
  std::vector<LoadCase> cases;
  std::vector<LoadArrow> arrows;

  int dimension() const { return mesh->dimension(); }
  std::vector<elasticity::FacetSpring> facet_springs() const;
};

/// Some boundary facets of a body.
struct Part {
  std::shared_ptr<Body> body;
  std::string name;
  std::vector<mesh::Facet> facets;
  /// "'block' top", for messages.
  std::string label() const { return "'" + body->name + "' " + name; }
  PartMark mark() const;
};

/// A body of this mesh and material; the mesh is checked (see mesh::check) and must be in one piece, connected
/// through facets. `force` per volume, may be empty.
std::shared_ptr<Body> make_body(std::string name, std::shared_ptr<const mesh::Mesh> mesh,
                                elasticity::MaterialField material,
                                const elasticity::VectorField& force);

/// Names of the parts that the body's mesh brings.
std::vector<std::string> part_names(const Body& body);
/// A part that the mesh brings. Throws InputError if there is none of that name or it has no facets.
Part named_part(const std::shared_ptr<Body>& body, const std::string& name);
/// The boundary facets that `chosen(centre, outward normal)` accepts. Throws InputError if there are none.
Part chosen_part(const std::shared_ptr<Body>& body, const std::string& name,
                 const std::function<bool(const mesh::Point&, const mesh::Point&)>& chosen);

/// Zero displacement of the components flagged. This and the next two throw InputError, and leave the
/// body as it was, where the support contradicts another one at a node.
void fix(Part& part, const std::array<bool, 3>& components);
/// Bilateral contact without friction: u·n = 0 on the part; at an edge between two of its sides, for both normals.
void slide(Part& part);
/// Prescribes the components given; a component left empty stays free.
void displace(Part& part, const std::array<elasticity::ScalarField, 3>& components, const std::string& load_case = {});

/// Force per length (2-D) or area (3-D).
void load(Part& part, const elasticity::VectorField& traction, const std::string& load_case = {});
/// Positive along the inward normal.
void pressure(Part& part, const elasticity::ScalarField& value, const std::string& load_case = {});
/// Elastic support per length or area; a component left empty has none. Throws InputError where negative.
void spring(Part& part, const std::array<elasticity::ScalarField, 3>& stiffness);

/// Numbers the body's free components. Throws InputError where supports contradict each other at a
/// node, naming both parts.
elasticity::Numbering number(const Body& body);

}  // namespace dotyk::scene
