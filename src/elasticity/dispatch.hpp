#pragma once

// From a mesh's cell type to its reference element, at compile time. Used inside this room only.

#include "elasticity/reference_element.hpp"

namespace dotyk::elasticity {

/// Gradients in the cell's own coordinates at `xi`, and the Jacobian there.
/// x: nodes × dim coordinates of the cell. Only their differences enter: far from the origin, too,
/// rigid motions then strain nothing.
template <class E>
double physical_gradient(const double x[][E::dim], const std::array<double, E::dim>& xi,
                         double g[][E::dim]) {
  double r[E::nodes][E::dim], j[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  E::gradient(xi, r);
  for (int i = 0; i < E::dim; ++i)
    for (int k = 0; k < E::dim; ++k) {
      j[i][k] = 0;
      for (int a = 1; a < E::nodes; ++a) j[i][k] += (x[a][i] - x[0][i]) * r[a][k];
    }
  double inverse[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {  // cofactors; in the plane j[2][2] = 1
      const int p = (i + 1) % 3, q = (i + 2) % 3, s = (k + 1) % 3, t = (k + 2) % 3;
      inverse[k][i] = j[p][s] * j[q][t] - j[p][t] * j[q][s];
    }
  const double det = j[0][0] * inverse[0][0] + j[0][1] * inverse[1][0] + j[0][2] * inverse[2][0];
  for (int a = 0; a < E::nodes; ++a)
    for (int i = 0; i < E::dim; ++i) {
      g[a][i] = 0;
      for (int k = 0; k < E::dim; ++k) g[a][i] += r[a][k] * inverse[k][i] / det;
    }
  return det;
}

/// Calls `body.template operator()<E>()` with the reference element of `element`.
template <class Body>
auto dispatch(mesh::Element element, Body&& body) {
  switch (element) {
    case mesh::Element::triangle_p1: return body.template operator()<TriangleP1>();
    case mesh::Element::quadrilateral_q1: return body.template operator()<QuadrilateralQ1>();
    case mesh::Element::tetrahedron_p1: return body.template operator()<TetrahedronP1>();
    case mesh::Element::hexahedron_q1: return body.template operator()<HexahedronQ1>();
    case mesh::Element::triangle_p2: return body.template operator()<TriangleP2>();
    case mesh::Element::quadrilateral_q2: return body.template operator()<QuadrilateralQ2>();
    case mesh::Element::tetrahedron_p2: return body.template operator()<TetrahedronP2>();
    case mesh::Element::hexahedron_q2: break;
  }
  return body.template operator()<HexahedronQ2>();
}

}  // namespace dotyk::elasticity
