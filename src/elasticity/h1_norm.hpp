#pragma once

#include "algebra/types.hpp"
#include "elasticity/numbering.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// The Gram matrix (lower triangle) of the vector Sobolev norm on a body's unknown components,
///   ‖u‖₁² = ∫ ∇u:∇u + u·u/ℓ²,
/// ℓ a length of the problem, so that both terms have one unit. Positive definite without any support.
algebra::SparseMatrix h1_gram(const mesh::Mesh& mesh, const Numbering& numbering, double length);

}  // namespace dotyk::elasticity
