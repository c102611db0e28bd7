#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "base/error.hpp"
#include "elasticity/material.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using elasticity::Plane;
using mesh::Point;

namespace {

constexpr double kYoung = 5, kPoisson = 0.28;

double difference(const elasticity::Hooke& a, const elasticity::Hooke& b) {
  double d = 0;
  for (int i = 0; i < a.dimension; ++i)
    for (int j = 0; j < a.dimension; ++j)
      for (int k = 0; k < a.dimension; ++k)
        for (int l = 0; l < a.dimension; ++l) d = std::max(d, std::abs(a.c[i][j][k][l] - b.c[i][j][k][l]));
  return d;
}

/// Hooke's law in Voigt form, solid.
DenseMatrix voigt() {
  const double mu = kYoung / (2 * (1 + kPoisson)), lambda = kYoung * kPoisson / ((1 + kPoisson) * (1 - 2 * kPoisson));
  DenseMatrix v = DenseMatrix::Zero(6, 6);
  v.topLeftCorner(3, 3).setConstant(lambda);
  v.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  return v;
}

/// Nodal displacement of a unit square or cube pulled along x by traction 1, held without restraint.
std::vector<double> pulled(const mesh::Mesh& m, const test::MaterialField& material) {
  std::vector<double> force(m.coordinates.size(), 0);
  test::add_traction(
      m, m.parts.at("right"),
      [](const Point&) {
        return Point{1, 0, 0};
      },
      force);
  const auto numbering = test::prescribe(
      m, [](const Point& x, int i) { return x[i] == 0; },
      [](const Point&) {
        return Point{0, 0, 0};
      });
  return test::solve(test::system_of(m, material, {}, force, numbering), numbering);
}

}  // namespace

TEST_CASE("the general stiffness of an isotropic material is the isotropic one") {
  CHECK(difference(elasticity::from_voigt(voigt()), elasticity::isotropic(kYoung, kPoisson, 3, Plane::strain)) < 1e-14);
  const DenseMatrix v = voigt();
  DenseMatrix strain(3, 3);  // plane strain: the xx yy xy part
  strain << v(0, 0), v(0, 1), 0, v(1, 0), v(1, 1), 0, 0, 0, v(5, 5);
  CHECK(difference(elasticity::from_voigt(strain), elasticity::isotropic(kYoung, kPoisson, 2, Plane::strain)) < 1e-14);
  DenseMatrix stress(3, 3);  // plane stress: E/(1−ν²) …
  stress << 1, kPoisson, 0, kPoisson, 1, 0, 0, 0, (1 - kPoisson) / 2;
  stress *= kYoung / (1 - kPoisson * kPoisson);
  CHECK(difference(elasticity::from_voigt(stress), elasticity::isotropic(kYoung, kPoisson, 2, Plane::stress)) < 1e-14);
}

TEST_CASE("uniaxial tension: closed forms of plane stress, plane strain and a solid") {
  for (const auto family : test::kFamilies) {
    const auto square = test::rectangle(family, 3, 3);
    const auto cube = test::box(family, 2, 2, 2);
    struct Case {
      const mesh::Mesh& m;
      Plane plane;
      double along, across, zz;
    };
    for (const Case& c : {Case{square, Plane::stress, 1 / kYoung, -kPoisson / kYoung, 0},
                          Case{square, Plane::strain, (1 - kPoisson * kPoisson) / kYoung, -kPoisson * (1 + kPoisson) / kYoung, kPoisson},
                          Case{cube, Plane::strain, 1 / kYoung, -kPoisson / kYoung, 0}}) {
      const auto material = test::steel(c.m.dimension(), kYoung, kPoisson, c.plane);
      const auto u = pulled(c.m, material);
      const auto exact = test::nodal(c.m, [&](const Point& x) {
        return Point{c.along * x[0], c.across * x[1], c.across * x[2]};
      });
      CHECK(test::largest_difference(u, exact) < 1e-14);
      for (const auto& s : elasticity::cell_stress(c.m, material, u)) {
        CHECK(s[0] == doctest::Approx(1).epsilon(1e-13));
        CHECK(s[2] == doctest::Approx(c.zz).epsilon(1e-13));
        for (int v : {1, 3, 4, 5}) CHECK(std::abs(s[v]) < 1e-13);
      }
    }
  }
}

TEST_CASE("a material that varies by cells: two layers in series, and equal values as one") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto m = test::unit(dim, family, 4);
      std::vector<double> E, nu(m.cell_count(), 0);  // ν = 0: layers do not disturb each other
      for (int c = 0; c < m.cell_count(); ++c) E.push_back(m.cell_centre(c)[0] < 0.5 ? 1 : 4);
      const auto u = pulled(m, test::MaterialField(E, nu, dim, Plane::strain));
      const auto exact = test::nodal(m, [](const Point& x) {
        return Point{x[0] < 0.5 ? x[0] : 0.5 + (x[0] - 0.5) / 4, 0, 0};
      });
      CHECK(test::largest_difference(u, exact) < 1e-13);
      const test::MaterialField even(std::vector<double>(m.cell_count(), kYoung), std::vector<double>(m.cell_count(), kPoisson),
                                     dim, Plane::stress);
      CHECK(test::largest_difference(pulled(m, even), pulled(m, test::steel(dim, kYoung, kPoisson, Plane::stress))) < 1e-14);
    }
}

TEST_CASE("materials out of range are refused") {
  CHECK_THROWS_WITH_AS(elasticity::check_isotropic(0, 0.3, false), "E is 0; Young's modulus must be positive",
                       InputError);
  CHECK_THROWS_AS(elasticity::check_isotropic(-1, 0.3, false), InputError);
  CHECK_THROWS_AS(elasticity::check_isotropic(NAN, 0.3, false), InputError);
  CHECK_THROWS_AS(elasticity::check_isotropic(INFINITY, 0.3, false), InputError);
  CHECK_THROWS_WITH_AS(elasticity::check_isotropic(1, 0.5, false), doctest::Contains("0.5 is incompressible"),
                       InputError);
  CHECK_NOTHROW(elasticity::check_isotropic(1, 0.5, true));
  CHECK_NOTHROW(elasticity::check_isotropic(1, -0.9, false));
  for (double nu : {-1.0, 0.6, static_cast<double>(NAN)})
    CHECK_THROWS_AS(elasticity::check_isotropic(1, nu, true), InputError);
  CHECK_THROWS_WITH_AS(elasticity::from_voigt(DenseMatrix::Identity(4, 4)), doctest::Contains("stiffness is 4x4"),
                       InputError);
  DenseMatrix v = DenseMatrix::Identity(3, 3);
  v(0, 1) = 0.1;
  CHECK_THROWS_WITH_AS(elasticity::from_voigt(v), "stiffness must be symmetric", InputError);
  v(1, 0) = v(0, 1) = 2;
  CHECK_THROWS_WITH_AS(elasticity::from_voigt(v), doctest::Contains("its least eigenvalue is -1"), InputError);
  v(0, 0) = NAN;
  CHECK_THROWS_AS(elasticity::from_voigt(v), InputError);
}
