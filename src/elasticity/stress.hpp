#pragma once

#include <array>
#include <vector>

#include "elasticity/assembly.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// σ in the order xx yy zz yz xz xy, force per area. In the plane yz = xz = 0,
/// and zz is the stress that plane strain needs (0 in plane stress).
using Stress = std::array<double, 6>;

double von_mises(const Stress& s);
/// Principal stresses, greatest first.
std::array<double, 3> principal(const Stress& s);

/// σ_h at every cell's centre, of the nodal displacement u (node × dimension).
std::vector<Stress> cell_stress(const mesh::Mesh& mesh, const MaterialField& material,
                                const std::vector<double>& u);

/// What the nodal displacement u makes of a cell, at its centre.
struct CellDeformation {
  double strain;    ///< the greatest principal one, without sign
  double rotation;  ///< an angle, of the skew part of ∇u
  double measure;   ///< of the cell, in units of its reference element's
  double energy;    ///< ½ ε:σ times the measure
};
std::vector<CellDeformation> cell_deformation(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<double>& u);

/// Nodal stress of the nodal displacement u (node × dimension). First order: recovered, see recover_stress(). Second order: the
/// mean of what the node's cells have there, of order 2 (superconvergent recovery would need each cell's own points; Zienkiewicz and Zhu 1992).
std::vector<Stress> nodal_stress(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<double>& u);

/// Nodal stress of cells of order 1 by superconvergent patch recovery (Zienkiewicz and Zhu 1992): the stress at cell
/// centres around a node, fitted by a linear polynomial; patches with too few cells (at the
/// boundary) take in the neighbours' cells. Reproduces linear stress exactly.
std::vector<Stress> recover_stress(const mesh::Mesh& mesh, const std::vector<Stress>& at_centres);

}  // namespace dotyk::elasticity
