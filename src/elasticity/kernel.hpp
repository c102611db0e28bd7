#pragma once

// Element matrices. Used inside this room only.

#include "elasticity/load.hpp"
#include "elasticity/material.hpp"
#include "elasticity/dispatch.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

template <class E>
void cell_coordinates(const mesh::Mesh& mesh, int cell, double x[][E::dim]) {
  const int* n = mesh.cell(cell);
  for (int a = 0; a < E::nodes; ++a)
    for (int i = 0; i < E::dim; ++i) x[a][i] = mesh.node(n[a])[i];
}

/// Calls visit(point, weight × measure, shape functions, their gradients) for each point of the cells' load rule.
template <class E, class Visit>
void for_each_load_point(const mesh::Mesh& mesh, Visit&& visit) {
  double x[E::nodes][E::dim], g[E::nodes][E::dim];
  for (int c = 0; c < mesh.cell_count(); ++c) {
    cell_coordinates<E>(mesh, c, x);
    for (int q = 0; q < E::load_points; ++q) {
      const auto xi = E::load_point(q);
      const double w = physical_gradient<E>(x, xi, g) * E::load_weight(q);
      const auto shape = E::shape(xi);
      CellPoint p{c, q, {0, 0, 0}};
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i) p.x[i] += shape[a] * x[a][i];
      visit(p, w, shape, g);
    }
  }
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
