#pragma once

#include <array>

#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Shape functions of a cell's nodes at the point x. False where x lies outside the cell by more
/// than `slack` in reference coordinates.
bool shape_at(const mesh::Mesh& mesh, int cell, const mesh::Point& x, double slack,
              std::array<double, mesh::kMostNodes>& shape);

}  // namespace dotyk::elasticity
