#pragma once

#include <memory>
#include <vector>

#include "scene/statement/scene.hpp"

namespace dotyk::scene {

/// The scene with nodes at other points, as if it had been set up there: meshes, supports' normals and shares, loads, springs, rows of
/// contact. `points`: a body each, node × dimension; empty where the body rests, which then is shared, as are contacts of such bodies.
///
/// What was given by functions stays with its material point: loads and stiffnesses per area and volume with the quadrature points,
/// prescribed displacements, friction and what was added to gaps with the nodes. Contacts and glues keep their pairs of nodes,
/// contacts M of contact/frame.hpp, by which the normals of both sides make the row's. Bodies and contacts carry what they are another design of as `origin`: handles of any design go on working with solutions of another.
///
/// Throws InputError for points of another number, an inverted cell (mesh::check), bodies or rigid shapes that overlap unless that is
/// meant, pairs of nodes that slide away from each other (by more than half a facet), a part that gets or loses a corner where sides
/// matter, a slide along an axis whose normal leaves the axis, a moving part against a rigid gap (a function of the place, which is not kept), and laws that other supports leave nothing to hold.
std::shared_ptr<Scene> moved(const Scene& scene, const std::vector<std::vector<double>>& points);

/// The scene as it is now, a design of its own: what is given to its bodies or added to it later is not in the copy.
std::shared_ptr<Scene> copy(const Scene& scene);

}  // namespace dotyk::scene
