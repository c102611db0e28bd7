#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "algebra/types.hpp"
#include "base/lists.hpp"
#include "elasticity/load.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Which displacement components of a body are unknown, and the values of the rest.
struct Numbering {
  SharedList<int> unknown;         ///< node × dimension + component → unknown, or -1 where prescribed
  std::vector<double> prescribed;  ///< the same index → value (0 where unknown); empty: all are 0
  std::vector<int> node;           ///< unknown → node; ascending
  int count() const { return static_cast<int>(node.size()); }
  double value(std::size_t component) const { return prescribed.empty() ? 0 : prescribed[component]; }
  /// The prescribed ones, 0 elsewhere.
  std::vector<double> values() const { return prescribed.empty() ? std::vector<double>(unknown.size(), 0.0) : prescribed; }
};

/// Numbers the components not marked in `fixed` (node × dimension flags), node by node. `prescribed`: as in Numbering.
inline Numbering number(const mesh::Mesh& mesh, const std::vector<char>& fixed,
                        std::vector<double> prescribed) {
  Numbering n;
  std::vector<int> unknown(fixed.size(), -1);
  n.prescribed = std::move(prescribed);
  n.node.reserve(static_cast<std::size_t>(std::ranges::count(fixed, 0)));
  const int dim = mesh.dimension();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) {
      unknown[i] = static_cast<int>(n.node.size());
      n.node.push_back(static_cast<int>(i) / dim);
    }
  n.unknown = std::move(unknown);
  return n;
}

/// An elastic support on one facet: stiffness per length (2-D) or area (3-D)
/// for each component, at the facet's quadrature points (see load.hpp).
struct FacetSpring {
  mesh::Facet facet;
  std::vector<std::array<double, 3>> stiffness;
};

/// ½ uᵀK u − fᵀu + offset is the body's energy, u its unknown components only.
struct Load {
  algebra::Vector f;  ///< unknowns; loads less what prescribed components pull
  double offset = 0;  ///< energy of the prescribed components alone
};

/// Bytes of a lower triangle on all components, with as many couplings as a grid of these cells has.
double matrix_bytes(const mesh::Mesh& mesh);

/// Assembles K, a body's stiffness ∫ ε(v):c:ε(u) with springs: the lower triangle, unknowns × unknowns. The pattern is made once from the mesh; entries of cells
/// are added in place (no triplets).
algebra::StoredMatrix assemble(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering);

/// What springs add to K: entries of the lower triangle, some places several times.
algebra::Triplets spring_stiffness(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering);

/// `force`: nodal loads, node × dimension; empty: none.
Load load(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const std::vector<double>& force,
          const Numbering& numbering);

/// Springs as rows: ½ Σ k_q (Sv − c)_q² + offset is their energy, v the unknowns.
struct SpringRows {
  algebra::SparseRows S;      ///< one a quadrature point and component with a spring and unknowns: its displacement there
  algebra::Vector stiffness;  ///< k_q > 0, force per displacement: the point's share of the boundary included
  algebra::Vector c;          ///< what prescribed components take off the displacement
  double offset = 0;          ///< of points where all is prescribed
};

SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering);

/// ∫ ε(φ):c:ε(u) + springs for every node and component (node × dimension), of
/// the displacement u (node × dimension): the forces that hold u in place.
std::vector<double> internal_force(const mesh::Mesh& mesh, const MaterialField& material,
                                   const std::vector<FacetSpring>& springs,
                                   const std::vector<double>& u);

/// What a spring adds to it at a point of its facet: force per length or area.
mesh::Point spring_force(const mesh::Mesh& mesh, const FacetSpring& spring, const FacetPoint& point, const std::vector<double>& u);

/// The Gram matrix (lower triangle) of the vector Sobolev norm on a body's unknown components,
///   ‖u‖₁² = ∫ ∇u:∇u + u·u/ℓ²,
/// ℓ a length of the problem, so that both terms have one unit. Positive definite without any support.
algebra::SparseMatrix h1_gram(const mesh::Mesh& mesh, const Numbering& numbering, double length);

}  // namespace dotyk::elasticity
