#pragma once
// Keys that all that draws has in common.
#include "figure/compose/compose_beam.hpp"
#include "figure/door/picture.hpp"
#include "script/bridge/bound.hpp"

namespace dotyk::script {

// Where the figure goes, what stands above it.
Key picture_key();
Key title_key(const char* help = "above the figure");

// Width and height.
Key size_key(const char* otherwise);

// File, title, and size where it is given. Throws InputError where a side of that is out of range.
void read_page(const Arguments& call, figure::Sheet& sheet);

// The direction towards the eye, given as `name`. Throws InputError where it is zero.
std::optional<figure::Vec3> read_direction(const Arguments& call, const char* name);

// Whether edges are drawn; `otherwise` where "edges" is not given.
figure::MeshEdges read_edges(const Arguments& call, figure::MeshEdges otherwise);

// Names of the units of length and force, of temperature too where there is `heat`.
Key units_key(bool heat = false);
figure::Units read_units(const Arguments& call);

}  // namespace dotyk::script
