#pragma once

#include <array>
#include <vector>

#include "elasticity/assembly.hpp"
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

/// d/dt of what springs add to internal_force(), added to `nodal`; stiffness per length or area stays with its facet point.
void add_spring_force_derivative(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const std::vector<double>& u,
                                 const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of add_body_force(), added to `nodal`; f is asked for at the points at rest.
void add_body_force_derivative(const mesh::Mesh& mesh, const CellField& f, const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of add_traction(), added to `nodal`; t, per length or area, is asked for at the points at rest and keeps its direction.
void add_traction_derivative(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                             const std::function<mesh::Point(const FacetPoint&)>& t, const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of add_traction() of t = −p n, n the outward normal, which turns with the facet: d(n ds) is that of the vector product of the
/// facet's tangents (in the plane the tangent turned by −90°). p is asked for at the points at rest.
void add_pressure_derivative(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                             const std::function<double(const FacetPoint&)>& p, const std::vector<double>& V, std::vector<double>& nodal);

/// d/dt of ∫ φ over a facet, one for each of its nodes.
std::array<double, 4> facet_weights_derivative(const mesh::Mesh& mesh, mesh::Facet facet, const std::vector<double>& V);

/// d/dt of a mesh's volume (area in the plane).
double volume_derivative(const mesh::Mesh& mesh, const std::vector<double>& V);

}  // namespace dotyk::elasticity
