#pragma once

#include "contact/matching.hpp"
#include "contact/multipliers.hpp"
#include "contact/rigid.hpp"

namespace dotyk::contact {

/// d/dt of a ContactRow when nodes move with a velocity V (node × dimension of a mesh; empty: it rests). The row keeps
/// its nodes and facets; what a function added to the gap when the row was made stays with the node.
struct RowDerivative {
  mesh::Point normal{0, 0, 0};
  double gap = 0;
  double weight = 0;  ///< of ∫φ over the row's facets
};

/// Of the rows of matching_rows(): the normal is that of frame.hpp, its M kept, where a part's own is m/|m|, m = Σ ∫φ n over
/// the facets of its side; the gap is (x₂ − x₁)·normal + added. `V` is the velocity of the first part's mesh, `W` that of the second's.
std::vector<RowDerivative> row_derivatives(const Face& first, const std::vector<ContactRow>& rows, const std::vector<double>& V,
                                           const Face& second, const std::vector<double>& W);

/// Of the rows of against(): a plane's normal is its own, against a ball it is that of frame.hpp, its M kept; the gap is measured along it.
/// Throws InputError where a node that moves lies before a RigidGap, whose gap as a function of place is not known.
std::vector<RowDerivative> row_derivatives(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                           const std::vector<ContactRow>& rows, const RigidShape& shape,
                                           const std::vector<double>& V);

/// d/dt of measures(surface).
std::vector<double> measure_derivatives(const Surface& surface, const std::vector<double>& V);

/// d/dt of tangents(n) for a normal that turns with dn ⟂ n: the tangents go on being made with the same axis.
std::vector<mesh::Point> tangent_derivatives(const mesh::Point& n, const mesh::Point& dn, int dimension);

}  // namespace dotyk::contact
