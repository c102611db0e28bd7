#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/lists.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Components at a point; in 2-D the third is not looked at.
using VectorField = std::function<mesh::Point(const mesh::Point&)>;
using ScalarField = std::function<double(const mesh::Point&)>;

/// A quadrature point of a facet: exact for quadratic integrands on straight facets, for those of degree 4 where cells are of
/// order 2.
struct FacetPoint {
  int index;           ///< 0 … facet_points − 1
  int nodes;           ///< nodes of the facet
  double shape[mesh::kMostFacetNodes];  ///< their shape functions
  double du[mesh::kMostFacetNodes], dv[mesh::kMostFacetNodes];  ///< the derivatives of these by the facet's coordinates; dv 0 in the plane
  double measure;      ///< weight × length (2-D) or area (3-D)
  mesh::Point x;       ///< where it is
  mesh::Point normal;  ///< unit, outward
};

int facet_points(const mesh::Mesh& mesh);
void for_each_facet_point(const mesh::Mesh& mesh, mesh::Facet facet,
                          const std::function<void(const FacetPoint&)>& visit);

/// A quadrature point of a cell, for loads.
struct CellPoint {
  int cell, index;  ///< index: 0 … cell_points − 1
  mesh::Point x;    ///< where it is
};

int cell_points(const mesh::Mesh& mesh);
/// Visits all points of the load rule: the cells in their order, and in each cell its points in their order.
void for_each_cell_point(const mesh::Mesh& mesh, const std::function<void(const CellPoint&)>& visit);

/// Components at a quadrature point of a cell.
using CellField = std::function<mesh::Point(const CellPoint&)>;

/// Adds ∫ φ f over all cells to `nodal` (node × dimension); f is force per volume, asked for cell by cell, point by point.
void add_body_force(const mesh::Mesh& mesh, const CellField& f, std::vector<double>& nodal);
void add_body_force(const mesh::Mesh& mesh, const VectorField& f, std::vector<double>& nodal);

/// Adds φ t of a facet's point, times its measure, to `nodal`.
void add_at(const mesh::Mesh& mesh, mesh::Facet facet, const FacetPoint& point, const mesh::Point& t, std::vector<double>& nodal);

/// Adds ∫ φ t over the facets; t is force per length (2-D) or area (3-D), asked for at each point.
void add_traction(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                  const std::function<mesh::Point(const FacetPoint&)>& t, std::vector<double>& nodal);

/// A force per volume that is linear in each cell, so that pieces of a cell, wherever they are cut, know theirs.
class LinearForce {
 public:
  LinearForce() = default;  ///< none
  /// In each cell the one that fits a field best, by least squares, at the points of the load rule. The field is asked once at each point.
  LinearForce(const mesh::Mesh& mesh, const VectorField& force);

  /// The force as a list of integers and one of real numbers, and the way back.
  Lists lists() const;
  LinearForce(const std::vector<int>& whole, std::vector<double> real);

  bool any() const { return numbers_ != nullptr; }
  bool varies() const { return !place_.empty(); }  ///< else it is one and the same everywhere
  mesh::Point at(int cell, const mesh::Point& x) const;
  /// The force in these cells, or in pieces of them, numbered as they come.
  LinearForce of(const std::vector<int>& cells) const;

 private:
  int dimension_ = 0;
  std::vector<int> place_;                               ///< of each cell, in numbers_
  std::shared_ptr<const std::vector<double>> numbers_;  ///< each: a point, the force there, its gradient row by row
};

}  // namespace dotyk::elasticity
