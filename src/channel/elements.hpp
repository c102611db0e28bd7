#pragma once

#include "algebra/types.hpp"

namespace dotyk::channel {

/// Continuous finite elements of any degree on 0 <= y <= y0, half of a channel whose flow is even in y
/// (u_y(0) = 0 is natural, u(y0) = 0 is built in). Cell ends y_i = y0 sin(i pi/(2 cells)) crowd at the
/// wall, where the boundary layers are; Lagrange nodes at the Chebyshev-Lobatto points of each cell.
class Elements {
 public:
  Elements(double half_width, int cells, int degree);  ///< throws InputError: cells >= 1, degree 1 ... 16

  int size() const { return cells_ * degree_; }  ///< unknowns: all nodes but the wall's
  const algebra::SparseMatrix& mass() const { return mass_; }            ///< int phi_i phi_j
  const algebra::SparseMatrix& stiffness() const { return stiffness_; }  ///< int phi_i' phi_j'
  const algebra::Vector& unit_load() const { return unit_load_; }        ///< int phi_i

  /// int phi_i (y/y0)^power dy: the power is in the weight of the quadrature of the first cell, so that
  /// it may be any number above -1.
  algebra::Vector power_load(double power) const;

  double value(const algebra::Vector& u, double y) const;  ///< 0 <= y <= y0

 private:
  double cell_end(int i) const;
  void assemble();
  algebra::Vector shapes(double s) const;       // of a cell mapped to 0 <= s <= 1
  algebra::Vector derivatives(double s) const;  // by s

  double half_width_;
  int cells_, degree_;
  algebra::Vector nodes_;  // in the unit cell
  algebra::SparseMatrix mass_, stiffness_;
  algebra::Vector unit_load_;
};

}  // namespace dotyk::channel
