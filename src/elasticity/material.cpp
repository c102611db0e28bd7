#include "elasticity/material.hpp"

#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"

namespace dotyk::elasticity {

void check_isotropic(double E, double nu, bool plane_stress) {
  if (!(E > 0) || !std::isfinite(E))
    throw InputError(text("E is ", E, "; Young's modulus must be positive"));
  if (!(nu > -1) || !(nu <= 0.5) || (nu == 0.5 && !plane_stress))
    throw InputError(text("nu is ", nu, "; Poisson's ratio must lie in (-1, 0.5)",
                          nu == 0.5 ? ": 0.5 is incompressible, which displacement elements "
                                      "cannot carry (0.499 can, with care for locking)"
                                    : ""));
}

Hooke by_lame(double lambda, double mu, int dimension) {
  Hooke h;
  h.dimension = dimension;
  h.isotropic = true;
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) {
      h.c[i][i][j][j] += lambda;
      h.c[i][j][i][j] += mu;
      h.c[i][j][j][i] += mu;
    }
  return h;
}

Hooke isotropic(double E, double nu, int dimension, Plane plane) {
  const bool stress = dimension == 2 && plane == Plane::stress;
  Hooke h = by_lame(stress ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)), dimension);
  h.zz_factor = dimension == 2 && !stress ? nu : 0;
  return h;
}

Lists MaterialField::lists() const {
  const double* c = &uniform_.c[0][0][0][0];
  std::vector<double> uniform(c, c + sizeof(uniform_.c) / sizeof(double));
  uniform.push_back(uniform_.zz_factor);
  return {{{uniform_.dimension, dimension_, static_cast<int>(plane_), uniform_.isotropic}}, {std::move(uniform), E_, nu_}};
}

MaterialField::MaterialField(const Lists& lists)
    : E_(lists.real[1]), nu_(lists.real[2]), dimension_(lists.whole[0][1]), plane_(static_cast<Plane>(lists.whole[0][2])) {
  uniform_.dimension = lists.whole[0][0], uniform_.isotropic = lists.whole[0][3] != 0;
  std::copy(lists.real[0].begin(), lists.real[0].end() - 1, &uniform_.c[0][0][0][0]);
  uniform_.zz_factor = lists.real[0].back();
}

MaterialField MaterialField::of(const std::vector<int>& cells) const {
  if (!varies()) return *this;
  std::vector<double> E, nu;
  for (const int c : cells) {
    E.push_back(E_[c]);
    nu.push_back(nu_[c]);
  }
  return MaterialField(std::move(E), std::move(nu), dimension_, plane_);
}

Hooke from_voigt(const algebra::DenseMatrix& v) {
  if (v.rows() != v.cols() || (v.rows() != 3 && v.rows() != 6))
    throw InputError(text("stiffness is ", v.rows(), "x", v.cols(),
                          "; it must be 3x3 (plane) or 6x6 (space)"));
  if (!v.allFinite()) throw InputError("stiffness has an entry that is not finite");
  if ((v - v.transpose()).norm() > 1e-9 * v.norm())
    throw InputError("stiffness must be symmetric");
  const algebra::Vector values = algebra::eigenvalues(v);
  const double least = values[0], greatest = values[values.size() - 1];
  // Below that the eigenvalue is rounding: a strain that costs no energy, though no rigid motion.
  if (!(least > 1e-15 * greatest))
    throw InputError(text("stiffness must be positive definite; its least eigenvalue is ", least, ", its greatest ", greatest));
  Hooke h;
  h.dimension = v.rows() == 3 ? 2 : 3;
  const std::vector<int> component = voigt_components(h.dimension);
  for (int a = 0; a < v.rows(); ++a)
    for (int b = 0; b < v.cols(); ++b) {
      const auto& [i, j] = kVoigt[component[a]];
      const auto& [k, l] = kVoigt[component[b]];
      h.c[i][j][k][l] = h.c[j][i][k][l] = h.c[i][j][l][k] = h.c[j][i][l][k] = v(a, b);
    }
  return h;
}

}  // namespace dotyk::elasticity
