#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// Unit tangents to the unit normal n: in the plane the one that n turned by 90° anticlockwise is; in space two,
/// perpendicular to each other, along axes where n is along one.
std::vector<mesh::Point> tangents(const mesh::Point& n, int dimension);

/// The axis that the first tangent in space lies along, made perpendicular: the one that n is least along.
int tangent_axis(const mesh::Point& n);

}  // namespace dotyk::contact
