#pragma once

#include <functional>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Components at a point; in 2-D the third is not looked at.
using VectorField = std::function<mesh::Point(const mesh::Point&)>;
using ScalarField = std::function<double(const mesh::Point&)>;

/// A quadrature point of a facet: exact for quadratic integrands on straight facets.
struct FacetPoint {
  int index;           ///< 0 … facet_points − 1
  int nodes;           ///< nodes of the facet
  double shape[4];     ///< their shape functions
  double measure;      ///< weight × length (2-D) or area (3-D)
  mesh::Point x;       ///< where it is
  mesh::Point normal;  ///< unit, outward
};

int facet_points(const mesh::Mesh& mesh);
void for_each_facet_point(const mesh::Mesh& mesh, mesh::Facet facet,
                          const std::function<void(const FacetPoint&)>& visit);

/// Adds ∫ φ f over all cells to `nodal` (node × dimension); f is force per volume.
void add_body_force(const mesh::Mesh& mesh, const VectorField& f, std::vector<double>& nodal);

/// Adds ∫ φ t over the facets; t is force per length (2-D) or area (3-D).
void add_traction(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                  const VectorField& t, std::vector<double>& nodal);

/// Adds −∫ φ p n over the facets: positive p pushes inwards.
void add_pressure(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                  const ScalarField& p, std::vector<double>& nodal);

/// ∫ φ over the facets at each node (node_count values): h/2 at the ends and h
/// inside for even edges (TR965 chapter 2's κ), a third of the triangles' area.
std::vector<double> lumped_measure(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

}  // namespace dotyk::elasticity
