#pragma once

// Element matrices. Used inside this room only.

#include "elasticity/material.hpp"
#include "elasticity/reference_element.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

template <class E>
void cell_coordinates(const mesh::Mesh& mesh, int cell, double x[][E::dim]) {
  const int* n = mesh.cell(cell);
  for (int a = 0; a < E::nodes; ++a)
    for (int i = 0; i < E::dim; ++i) x[a][i] = mesh.node(n[a])[i];
}

/// k[a][b][i][j] = ∫ ∂_k φ_a c_ikjl ∂_l φ_b over the cell, for a ≥ b.
template <class E>
void stiffness(const double x[][E::dim], const Hooke& h, double k[][E::nodes][E::dim][E::dim]) {
  constexpr int d = E::dim;
  for (int a = 0; a < E::nodes; ++a)
    for (int b = 0; b <= a; ++b)
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) k[a][b][i][j] = 0;
  for (int q = 0; q < E::points; ++q) {
    double g[E::nodes][d];
    const double w = physical_gradient<E>(x, E::point(q), g) * E::weight(q);
    for (int b = 0; b < E::nodes; ++b) {
      double t[d][d][d];  // c_ikjl ∂_l φ_b
      for (int i = 0; i < d; ++i)
        for (int m = 0; m < d; ++m)
          for (int j = 0; j < d; ++j) {
            t[i][m][j] = 0;
            for (int l = 0; l < d; ++l) t[i][m][j] += h.c[i][m][j][l] * g[b][l];
            t[i][m][j] *= w;
          }
      for (int a = b; a < E::nodes; ++a)
        for (int i = 0; i < d; ++i)
          for (int j = 0; j < d; ++j)
            for (int m = 0; m < d; ++m) k[a][b][i][j] += g[a][m] * t[i][m][j];
    }
  }
}

}  // namespace dotyk::elasticity
