// Contacts of a scene figure, and the rigid obstacles as their nodes see them.
#pragma once

#include "figure/door/picture.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::figure {

ContactPicture contact_picture(const scene::Contact& contact, const scene::ContactResult& result);

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

}  // namespace dotyk::figure
