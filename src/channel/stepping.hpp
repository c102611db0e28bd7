#pragma once

#include <memory>

#include "algebra/direct/indefinite.hpp"
#include "algebra/types.hpp"
#include "base/monitor.hpp"
#include "channel/data.hpp"

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

  /// int phi_i (y/y0)^power dy. In the first cell the power is the weight of the quadrature, so that it may be any number above -1.
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

/// The modified Hartmann problem by finite elements in y (order degree + 1) and Radau IIA with three
/// stages in t (order 5, L-stable: the kink that the initial profile makes with the walls dies out).
/// Knows nothing of the series: the two check each other. Starts from the projection of the initial profile.
class Stepping {
 public:
  /// Throws InputError: data as check(), cells and degree as Elements, step positive and finite.
  Stepping(const Data& data, double step, int cells = 16, int degree = 8);

  void step();  ///< by one step
  /// By equal steps, none longer than the step, to this time, not before now. Throws Interrupted where the monitor asks to
  /// stop: it is at the time reached then, and can go on from it.
  void advance(double time, Monitor& monitor);

  double time() const { return time_; }
  long long steps() const { return steps_; }
  double velocity(double y) const;  ///< now; throws InputError for |y| > y0
  const Data& data() const { return data_; }

 private:
  void step(double length);
  void factor(double length);

  Data data_;
  double step_, time_ = 0;
  long long steps_ = 0;
  Elements elements_;
  algebra::Vector u_;
  struct Factor {
    algebra::SparseMatrix matrix;  // the factor refers to it
    algebra::SparseLu lu{matrix};
  };
  std::unique_ptr<const Factor> factor_;
  double factored_ = 0;  // the length of step that factor_ is for, 0: none
};

}  // namespace dotyk::channel
