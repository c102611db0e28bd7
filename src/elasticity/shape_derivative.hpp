#pragma once

#include <vector>

#include "elasticity/load.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// What changes when nodes move with the velocity V (node × dimension), exactly, element by element:
///   d(∂φ) = −(∇V)ᵀ ∂φ,   d(dx) = div V dx,   of a facet d(ds) = div_Γ V ds.
/// Displacements u, materials, and loads per volume and area stay with the nodes, cells and facet points that have them.

/// d/dt of internal_force() without springs: (dK) u, node × dimension (P7 (6)).
std::vector<double> internal_force_derivative(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                                              const std::vector<double>& V);

/// d/dt of add_body_force(), added to `nodal`; f is asked for at the points at rest.
void add_body_force_derivative(const mesh::Mesh& mesh, const VectorField& f, const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of add_traction(), added to `nodal`; t, per length or area, is asked for at the points at rest and keeps its direction.
void add_traction_derivative(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                             const std::function<mesh::Point(const FacetPoint&)>& t, const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of a mesh's volume (area in the plane).
double volume_derivative(const mesh::Mesh& mesh, const std::vector<double>& V);

}  // namespace dotyk::elasticity
