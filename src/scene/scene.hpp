#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/matching.hpp"
#include "contact/rigid.hpp"
#include "scene/body.hpp"

namespace dotyk::scene {

/// A pair of parts, or a part and a rigid shape, in contact or glued.
struct Contact {
  enum class Kind { contact, glue };
  Kind kind = Kind::contact;
  std::string name;  ///< "contact of 'block' top with a rigid gap"
  Part first;
  Part second;       ///< second.body is null against a rigid shape
  std::vector<contact::ContactRow> rows;   ///< of a contact
  std::vector<contact::NodePair> glued;    ///< of a glue
  contact::RigidShape shape;               ///< for drawing only; a gap function is not kept
};

/// Bodies and what joins them.
struct Scene {
  std::vector<std::shared_ptr<Body>> bodies;
  std::vector<std::shared_ptr<const Contact>> contacts;

  int dimension() const { return bodies.front()->dimension(); }
  int index_of(const Body* body) const;  ///< -1 where it is not of this scene
};

/// Throws InputError for no bodies, a body twice, two of one name, or mixed dimensions.
std::shared_ptr<Scene> make_scene(std::vector<std::shared_ptr<Body>> bodies);

/// Frictionless contact of two parts with matching nodes. Throws as contact::between, and for a
/// part whose body is not in the scene.
std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& first, const Part& second,
                                           const elasticity::ScalarField& added_gap, bool interference = false);
/// Frictionless contact of a part with a rigid shape. Throws as contact::against.
std::shared_ptr<const Contact> add_contact(Scene& scene, const Part& part, const contact::RigidShape& shape,
                                           const elasticity::ScalarField& added_gap, bool interference);
/// Ties two parts with matching nodes together: no jump of the displacement.
std::shared_ptr<const Contact> add_glue(Scene& scene, const Part& first, const Part& second);

/// What will be modelled, what is free to move, whether a solution exists, which method and why.
std::string plan(const Scene& scene);
/// A short report: bodies with sizes, supports, contacts.
std::string describe(const Scene& scene);

}  // namespace dotyk::scene
