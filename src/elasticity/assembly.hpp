#pragma once

#include <array>
#include <vector>

#include "algebra/types.hpp"
#include "elasticity/material.hpp"
#include "elasticity/numbering.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// An elastic support on one facet: stiffness per length (2-D) or area (3-D)
/// for each component, at the facet's quadrature points (see load.hpp).
struct FacetSpring {
  mesh::Facet facet;
  std::vector<std::array<double, 3>> stiffness;
};

/// ½ uᵀK u − fᵀu + offset is the body's energy, u its unknown components only.
struct System {
  algebra::SparseMatrix K;  ///< lower triangle, unknowns × unknowns
  algebra::Vector f;        ///< unknowns; loads less what prescribed components pull
  double offset = 0;        ///< energy of the prescribed components alone
};

/// Bytes of a lower triangle on all components, with as many couplings as a grid of these cells has.
double matrix_bytes(const mesh::Mesh& mesh);

/// Assembles a body's stiffness ∫ ε(v):c:ε(u) and springs. `force`: nodal loads,
/// node × dimension. The pattern is made once from the mesh; entries are added
/// in place (no triplets).
System assemble(const mesh::Mesh& mesh, const MaterialField& material,
                const std::vector<FacetSpring>& springs, const std::vector<double>& force,
                const Numbering& numbering);

/// Springs as rows: ½ Σ k_q (Sv)_q² of the unknowns v is what assemble() makes of them.
struct SpringRows {
  algebra::SparseRows S;      ///< one a quadrature point and component with a spring: its displacement there
  algebra::Vector stiffness;  ///< k_q > 0, force per displacement: the point's share of the boundary included
};

/// Throws std::logic_error where a spring acts on a prescribed component.
SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering);

/// ∫ ε(φ):c:ε(u) + springs for every node and component (node × dimension), of
/// the displacement u (node × dimension): the forces that hold u in place.
std::vector<double> internal_force(const mesh::Mesh& mesh, const MaterialField& material,
                                   const std::vector<FacetSpring>& springs,
                                   const std::vector<double>& u);

}  // namespace dotyk::elasticity
