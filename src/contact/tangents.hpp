#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// Unit tangents to the unit normal n: in the plane the one that n turned by 90° anticlockwise is; in space two,
/// perpendicular to each other, along axes where n is along one.
std::vector<mesh::Point> tangents(const mesh::Point& n, int dimension);

}  // namespace dotyk::contact
