#pragma once

#include <array>

#include "contact/contact_row.hpp"

namespace dotyk::contact {

/// A facet of the contact boundary with the contact row at each of its corners.
struct SurfaceFacet {
  mesh::Facet facet;
  int corners;
  int row[4];  ///< -1 at the tip of a crack, where one node lies on both sides: no jump there
};

/// Γ_c: the facets of the (first) part all of whose corners have a contact row, or lie on both parts. What of
/// a part overhangs the other one is left out.
struct Surface {
  const mesh::Mesh& mesh;
  std::vector<SurfaceFacet> facets;
  int rows;  ///< how many contact rows there are; some may touch no facet
};

/// `facets` are the first part's, `second` those of a second part on the same mesh (else empty).
Surface surface(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<ContactRow>& rows,
                const std::vector<mesh::Facet>& second);

/// ∫ φ_a φ_b over a facet of order 1; exact for segments, triangles and parallelograms.
using Gram = std::array<std::array<double, 4>, 4>;
Gram gram(const mesh::Mesh& mesh, mesh::Facet facet);

/// ∫ φ over the surface of order 1, a contact row each: κ of TR965 (2.16); 0 where a row touches no facet.
std::vector<double> measures(const Surface& surface);

/// Which pieces of the surface hang together, one number a contact row (-1 off the surface). Rows of different
/// sides of an edge are different, so that the surface falls apart at its edges.
std::vector<int> components(const Surface& surface);

}  // namespace dotyk::contact
