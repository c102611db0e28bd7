#pragma once

#include <vector>

#include "shape/derivative/boundary_motion.hpp"

namespace dotyk::shape {

/// How the nodes of a mesh follow a moving part of its boundary.
enum class Extension {
  /// Every component harmonic, by finite elements on the first mesh, whichever it is: min ∫ |∇V|². Affine motions of the
  /// whole boundary are continued exactly. (The stiffness is that of Hooke's law with λ = −μ, 2 ε:ε − (div)², which differs
  /// from |∇V|² by ∇V:∇Vᵀ − (div V)², for fields that vanish or slide along planes the integral of nothing.)
  harmonic,
  /// Along the lines of a mapped grid of quadrilaterals, or of pairs of triangles, from the part to the opposite side: the
  /// velocity falls linearly, by the length of the line, to zero. In the plane.
  structured,
};

/// Node velocities (node × dimension) of the part's body, one set a variable: those of `motion` on the part, zero on `fixed`
/// parts. In the plane, harmonic or structured, the sides that go on from the ends of the part stretch with them, so that
/// straight ones stay straight and the field is smooth at the corner: harmonic ones to their next corner (a turn of more
/// than 30°); all else of the boundary stays. In space nodes beside the part slide along the faces on which they
/// lie (an edge that bends stays); where the part's own edges move against one another, fields grow logarithmically there.
///
/// Meshes follow linearly, X(α) = X₀ + Σ α_i V_i: the velocities are those of every later design, too.
///
/// Throws InputError for a fixed part of another body or with nodes that `motion` moves (structured: that it would move
/// anywhere), and where a structured mesh is not such a grid.
std::vector<std::vector<double>> extend(const BoundaryMotion& motion, const std::vector<scene::Part>& fixed, Extension kind = Extension::harmonic);

/// Of `extend`, kind structured, but for what is fixed. Throws as it does.
std::vector<std::vector<double>> extend_along_lines(const BoundaryMotion& motion);

}  // namespace dotyk::shape
