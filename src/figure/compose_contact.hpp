// Contacts of a scene figure, and the rigid obstacles as their nodes see them.
#pragma once

#include "figure/picture.hpp"
#include "scene/solution.hpp"

namespace dotyk::figure {

ContactPicture contact_picture(const scene::Contact& contact, const scene::ContactResult& result);

// The obstacle of a contact with a rigid shape, for bodies drawn at x + m u (m is `factor`). The motion d of the shape
// (`move`) is magnified as displacements are, and the gap g₀ at rest as far as some node has come towards the
// obstacle. With w = u − d a node's displacement relative to the obstacle, n the direction towards the obstacle and
// c = max(0, greatest w·n), the obstacle passes through
//   x + g₀ n + m d + (m − 1)(w_t + min(g₀, c) n).
// At m = 1 this is where the obstacle is. A closed node (w·n = g₀) lies on it at any m ≥ 1; an open one stands off it
// by between its gap and m times its gap; where gaps are wide the obstacle keeps its shape.
// Nodes that do not face the obstacle, and those farther from it than a quarter of the scene's `size`, are left out.
// In the plane a half-space, which ends nowhere, is drawn a little beyond the contact.
RigidPicture obstacle_picture(const scene::Contact& contact, const scene::ContactResult& result, const Vec3& move, double factor,
                              double size);

}  // namespace dotyk::figure
